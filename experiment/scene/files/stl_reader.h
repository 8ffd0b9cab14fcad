/// STL files (stereolithography): separate triangles, in binary or text.
#pragma once

#include "experiment/scene/files/mesh_source.h"
#include "experiment/scene/making/raw_mesh.h"

namespace overt {

enum class StlForm : std::uint8_t { none, binary, text };

/// Which form of STL the content is, by its own evidence: binary if the length is what the triangle count at
/// byte 80 asks for (whatever the first word), text if it begins with "solid" and holds no control characters
/// there, otherwise none.
StlForm stl_form(const MeshSource& source);

/// Reads a binary STL file: corners at exactly the same place become one vertex, stored normals and
/// attributes are passed over. Throws InputError with the byte offset if the length does not fit the number
/// of triangles, if there are none, or if a coordinate is not finite.
RawMesh read_binary_stl(const MeshSource& source);

/// Reads a text STL file, with one `solid` or several. Throws InputError with line and column if a word is
/// missing or wrong, a coordinate is not finite, or there are no facets.
RawMesh read_text_stl(const MeshSource& source);

} // namespace overt
