/// Writing a mesh as PLY.
#pragma once

#include <filesystem>

#include "experiment/scene/mesh.h"

namespace overt {

/// Writes a binary little-endian PLY with the property uchar `part` for each face and a line
/// `comment part INDEX NAME` for each part name. Reading it back without turning, scaling or cleaning gives
/// the same mesh to the bit, and so does import_mesh if the mesh was clean.
///
/// The mesh goes to a file of another name in the same folder, which is synced and then takes the place of
/// `path`: there is never half a mesh under that name, and what stood there is replaced. Throws RecordError,
/// leaving nothing behind, if the folder cannot be written, the disk is full, or a part name has a line end.
void write_ply(const std::filesystem::path& path, const Mesh& mesh);

} // namespace overt
