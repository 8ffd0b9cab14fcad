/// A sculpture ready to be shown: its mesh as all parts of the program use it, and where the camera stands.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiment/base/content_hash.h"
#include "experiment/protocol/protocol.h"
#include "experiment/scene/mesh_parts.h"
#include "experiment/scene/viewing.h"
#include "experiment/screen_geometry.h"

namespace overt {

/// Of a sculpture's lengths: "mm", or "own" where the protocol does not know the unit of its mesh.
std::string_view unit_of_lengths(const SculptureSettings& settings);

/// Millimetres in a unit by its name; 1 for a mesh's own.
double mm_of_unit(std::string_view unit);

struct Sculpture {
    std::string id;
    /// Without triangles if the protocol gives none: then its stimuli are frames. Where it gives ready-made
    /// maps, the part names are those of the maps.
    Mesh mesh;
    ContentHash mesh_hash;  ///< see hash_of_mesh
    glm::dvec3 origin{0.0}; ///< of the mesh's coordinates in those of its file, turned and scaled alike
    SceneView scene;
    std::vector<std::string> remarks; ///< on the mesh, for the experimenter

    bool has_mesh() const { return !mesh.triangles.empty(); }
};

/// The part "head" that the protocol describes, in the coordinates of the file; nothing if it describes none.
std::optional<PartRegion> head_region(const SculptureSettings& settings);

/// Of positions, triangles and parts: what a mesh file of any format is to the program.
ContentHash hash_of_mesh(const Mesh& mesh);

/// Imports or makes the mesh of one sculpture of the protocol and places the camera. A sculpture that overt
/// makes itself is kept as PLY in `cache` and taken from there the next time. Throws InputError naming the
/// file or the key.
Sculpture load_sculpture(const SculptureSettings& settings, const Protocol& protocol,
                         const std::filesystem::path& cache);

/// Whether any of the sculpture can be in the picture when it is turned by `angle`. Only for one with a mesh.
bool is_in_picture(const Sculpture& sculpture, Degrees angle);

/// All sculptures of the protocol, in its order.
std::vector<Sculpture> load_sculptures(const Protocol& protocol, const std::filesystem::path& cache);

} // namespace overt
