/// An object ready to be shown: its mesh as all parts of the program use it, and where the cameras stand.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "experiment/base/content_hash.h"
#include "experiment/protocol/protocol.h"
#include "experiment/scene/making/mesh_parts.h"
#include "experiment/scene/shared_mesh.h"
#include "experiment/scene/surface_appearance.h"
#include "experiment/scene/viewing.h"
#include "experiment/screen_geometry.h"
#include "experiment/stimulus/object_points.h"

namespace overt {

/// Of an object's lengths: "mm", or "own" where the protocol does not know the unit of its mesh.
std::string_view unit_of_lengths(const ObjectSettings& settings);

/// Millimetres in a unit by its name; 1 for a mesh's own.
double mm_of_unit(std::string_view unit);

struct Object {
    std::string id;
    /// Without triangles if the protocol gives none: then its stimuli are frames. Where it gives ready-made
    /// maps, the part names are those of the maps. Objects of one protocol that are of one shape share it.
    SharedMesh mesh;
    ContentHash mesh_hash; ///< see hash_of_mesh
    /// How the surface looks by its file, where a material of the protocol asks for that; else nothing.
    std::shared_ptr<const SurfaceAppearance> appearance;
    ContentHash appearance_hash; ///< see hash_of_appearance; empty without one
    /// The mesh's file and the pictures that it has or names, with "; " between them; empty without one.
    std::string appearance_files;
    glm::dvec3 origin{0.0}; ///< of the mesh's coordinates in those of its file, turned and scaled alike
    std::vector<SceneView> scenes;    ///< by view
    std::vector<ObjectPoint> points;  ///< of the protocol's lists, list by list
    std::vector<std::string> remarks; ///< on the mesh, for the experimenter

    bool has_mesh() const { return !mesh->triangles.empty(); }
    const SceneView& scene(int view = 0) const { return scenes.at(static_cast<std::size_t>(view)); }
};

/// The areas that the protocol describes, in the coordinates of the file.
std::vector<PartRegion> area_regions(const ObjectSettings& settings);

/// Most areas of an object that is shown by ready-made maps.
inline constexpr std::size_t most_map_areas = 7;

/// The parts of such an object: one for each set of the areas that the protocol describes (areas.h), of which
/// the first is in none; bit i of a part's index stands for area i.
std::vector<std::string> map_part_names(const ObjectSettings& settings);

/// The areas of all objects, each once.
std::vector<std::string> areas_of(std::span<const Object> objects);

/// Of positions, triangles and parts: what a mesh file of any format is to the program.
ContentHash hash_of_mesh(const Mesh& mesh);

/// Imports or makes the mesh of one object of the protocol and places the camera of each view. An object that
/// overt makes itself is kept as PLY in `cache` and taken from there the next time. Throws InputError naming
/// the file or the key.
Object load_object(const ObjectSettings& settings, const Protocol& protocol,
                   const std::filesystem::path& cache);

/// Finds the places of a list on an object, the `index`-th of the protocol, and adds them; does nothing where
/// the list is of another. Throws InputError.
void add_points(Object& object, const Protocol& protocol, const PointListSettings& list, std::size_t index);

/// Whether any of the object can be in a view's picture when it stands like `pose`. Only for one with a
/// mesh.
bool is_in_picture(const Object& object, int view, const ObjectPose& pose);

/// All objects of the protocol, in its order, with their points. A mesh that several of them are of, to the
/// last triangle and part, is read and kept once.
std::vector<Object> load_objects(const Protocol& protocol, const std::filesystem::path& cache);

} // namespace overt
