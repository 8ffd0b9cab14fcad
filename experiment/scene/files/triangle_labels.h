/// Labels of a mesh's triangles that its own file does not give: from its vertices, or from a file beside it.
#pragma once

#include <filesystem>
#include <span>

#include "experiment/scene/making/raw_mesh.h"

namespace overt {

/// The middle one of a triangle's three labels: the one that two corners share, if two do.
PartLabel middle_label(PartLabel a, PartLabel b, PartLabel c);

/// Labels each triangle by its corners: the middle one of their three labels, which is the one that two
/// corners share, if two do. `labels`: one for each vertex.
void label_by_corners(RawMesh& mesh, std::span<const PartLabel> labels);

/// Labels the mesh by a file beside it, which replaces labels and names that the mesh has:
///
/// A text file, an id map: a whole number for each triangle of the mesh, or for each of its vertices, in the
/// order of the mesh file; blanks and line ends separate them. What follows a # is a comment, but a line
/// "# part LABEL NAME" names a part. A polygon of n corners counts as n - 2 triangles. With such lines alone
/// the labels stay those that the mesh file has, under these names.
///
/// A text file without numbers, but with lines "# colour #RRGGBB NAME" or "# colour R G B NAME": parts are
/// painted on the surface (label_by_colours()), of `mesh_file` itself, or of a copy of it that a line
/// "# colours FILE" names, by its path from this file's folder.
///
/// FreeSurfer's .annot and .label (freesurfer.h).
///
/// Throws InputError with the place for what is no label, for another number of labels than of triangles or
/// vertices, and for a copy with other triangles.
void label_by_file(RawMesh& mesh, const std::filesystem::path& file, const std::filesystem::path& mesh_file);

} // namespace overt
