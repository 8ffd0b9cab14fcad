/// Makes of a mesh as it was found one that surface statistics can rely on: each place is one vertex, each
/// piece of surface one triangle, and the front of a closed mesh is its outside.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "experiment/scene/mesh.h"
#include "experiment/scene/surface_appearance.h"

namespace overt {

/// What was found and done. The counts of edges and components are those of the cleaned mesh.
struct MeshCleaningReport {
    std::size_t vertices_read = 0;
    std::size_t triangles_read = 0;
    std::size_t vertices_welded = 0;          ///< that became one with an earlier vertex
    std::size_t vertices_moved = 0;           ///< of these, those that were not at the very same place
    double weld_tolerance = 0.0;              ///< in the mesh's unit
    std::size_t degenerate_faces_dropped = 0; ///< two corners at one vertex, or all three on a line
    std::size_t collapsed_faces_dropped = 0;  ///< of these, those that had an area before they were welded
    std::size_t duplicate_faces_dropped = 0;  ///< same corners, same front as an earlier one
    std::size_t unreferenced_vertices_dropped = 0; ///< of no triangle
    std::size_t vertices_without_place = 0;        ///< likewise, with a coordinate that is none
    std::size_t crossing_faces = 0;                ///< whose outline crosses itself
    glm::dvec3 origin{0.0}; ///< of the object, in the file's coordinates turned and in the mesh's unit
    std::vector<std::string> part_remarks; ///< see label_parts()
    double rounding = 0.0; ///< that coordinates from the file's own origin would have; 0 if that was kept
    std::size_t boundary_edges = 0;
    std::size_t non_manifold_edges = 0;
    std::size_t conflicting_edges = 0; ///< between two triangles whose fronts disagree
    std::size_t components = 0;
    bool inverted = false; ///< the signed volume was negative: the fronts faced inwards
    bool flipped = false;  ///< all faces were turned: it was inverted, closed and consistent
};

/// Cleans the mesh in place. Vertices within the tolerance (in the mesh's unit; 0: at equal coordinates) of
/// an earlier one are welded to it; degenerate faces, repeated faces and vertices of no face go; the rest
/// keeps its order, triangles keep their parts. A closed and consistent mesh that is inside out has all faces
/// turned (the second and third corner change places). The result may have no triangles. Cleaning a second
/// time changes nothing. Throws InputError for an impossible tolerance.
///
/// Takes up to 16 bytes for each triangle meanwhile. `from`, if it is given, gets where the corners of each
/// triangle that is left come from.
MeshCleaningReport clean_mesh(Mesh& mesh, double weld_tolerance = 0.0,
                              std::vector<CornersFrom>* from = nullptr);

/// What an experimenter should know of it, a sentence each; empty if there is nothing to say.
std::vector<std::string> describe(const MeshCleaningReport& report);

} // namespace overt
