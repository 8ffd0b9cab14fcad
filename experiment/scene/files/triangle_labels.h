/// Labels of a mesh's triangles that its own file does not give: from its vertices, or from a file beside it.
#pragma once

#include <filesystem>
#include <span>

#include "experiment/scene/making/raw_mesh.h"

namespace overt {

/// Labels each triangle by its corners: the middle one of their three labels, which is the one that two
/// corners share, if two do. `labels`: one for each vertex.
void label_by_corners(RawMesh& mesh, std::span<const PartLabel> labels);

/// Labels the mesh by a text file, an id map: a whole number for each triangle of the mesh, or for each of
/// its vertices, in the order of the mesh file; blanks and line ends separate them. What follows a # is a
/// comment, but a line "# part LABEL NAME" names a part. Replaces labels and names that the mesh has. A
/// polygon of n corners counts as n - 2 triangles. Throws InputError with the place for what is no label, and
/// for another number of labels than of triangles or vertices.
void label_by_file(RawMesh& mesh, const std::filesystem::path& file);

} // namespace overt
