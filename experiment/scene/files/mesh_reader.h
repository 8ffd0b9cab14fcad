/// Reading an object from a file: what format it is in, which way is up, and what had to be tidied.
///
/// Memory: RawMesh takes 24 bytes for each vertex and 12 for each triangle (16 with labels); a closed mesh
/// has half as many vertices as triangles, so 24 (28) bytes for each triangle, and Mesh 19. While a file is
/// read its bytes are in memory too (19 for each triangle of a usual binary PLY, 50 of a binary STL, about 35
/// of an OBJ); cleaning takes at most 16 more. Importing 20 million triangles from a binary PLY with parts
/// takes about 1 GB at its peak (reckoned from these).
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

#include "experiment/scene/making/mesh_cleaning.h"
#include "experiment/scene/making/mesh_parts.h"
#include "experiment/scene/making/raw_mesh.h"
#include "experiment/scene/mesh.h"

namespace overt {

/// Reads a PLY, OBJ, STL or glTF file as it is. The format is told by the content, and by the file's
/// extension only where the content does not say. Throws InputError with the file and the place for a file
/// that cannot be read, is of no known format, is cut off, or contradicts itself; see ply_reader.h,
/// obj_reader.h, stl_reader.h, gltf_reader.h.
RawMesh read_mesh_file(const std::filesystem::path& path, MeshWanted wanted = MeshWanted::shape);

/// Whether the file is one of glTF by its name, .gltf or .glb: then +y points up in it and its unit is the
/// metre, whatever program wrote it.
bool is_gltf_name(const std::filesystem::path& path);

/// Axis of the file's coordinates that points up.
enum class UpAxis : std::uint8_t { x, y, z, minus_x, minus_y, minus_z };

/// The axis called "x", "y", "z", "-x", "-y" or "-z". Throws InputError for another name.
UpAxis up_axis_named(std::string_view name);

/// The rotation (determinant +1) that brings the file's up axis to +z. With up = y or -y it brings +z, where
/// such figures face, to -y; with the others it leaves the y axis alone, so that what faces -y goes on doing
/// so.
glm::dmat3 z_up_from_file(UpAxis up);

/// How the coordinates of a mesh file become those of the object.
struct MeshImport {
    UpAxis up = UpAxis::z;
    double scale = 1.0;           ///< object unit per file unit, above 0
    std::filesystem::path labels; ///< an id map, see label_by_file(); empty: the labels of the mesh file
    /// As a share of the diagonal of the mesh's box; 0: only vertices at equal coordinates are welded.
    double weld_tolerance = 0.0;
    /// What of the file divides it into parts; left out: its groups, of glTF its materials.
    std::optional<bool> parts_by_material = {};
    /// Regions of parts in the file's coordinates, beside the parts that the file labels (label_parts).
    std::vector<PartRegion> regions;
};

/// Reads, labels, turns, scales and cleans a mesh, and reports what was cleaned. All of it is done in doubles
/// up to the last step. A mesh so far from its origin that 32-bit coordinates would move its points by more
/// than the millionth of its box's diagonal gets an origin of its own near its middle, which the report
/// names. Vertices that no face uses have no say in that, nor in what is welded. Throws InputError, naming
/// the file, as read_mesh_file and label_parts do, for a scale that is not positive or makes coordinates
/// overflow, and for a mesh without any area.
///
/// `appearance`, if it is given, gets how the surface looks, for the triangles of the mesh that is returned;
/// pictures are read only then. It is left empty where the file says nothing of it.
Mesh import_mesh(const std::filesystem::path& path, const MeshImport& import, MeshCleaningReport& report,
                 SurfaceAppearance* appearance = nullptr);

} // namespace overt
