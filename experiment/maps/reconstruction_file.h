/// Writing a reconstruction for mesh programs.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "experiment/maps/reconstruction.h"

namespace overt {

/// Writes PLY or OBJ, by the extension of `file`; at once or not at all.
///
/// PLY: binary little-endian; each vertex with x y z, its normal nx ny nz, uchar `part` and ushort `views`; a
/// line `comment part INDEX NAME` for each part name. OBJ: vertices and normals, faces in a group for each
/// part (that of their first corner), or points if there are no triangles.
///
/// Throws InputError for another extension, RecordError if the file cannot be written.
void write_reconstruction(const std::filesystem::path& file, const Reconstruction& reconstruction,
                          std::span<const std::string> part_names);

} // namespace overt
