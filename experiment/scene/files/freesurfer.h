/// Files of FreeSurfer: surfaces of the brain, and what regions their vertices belong to.
#pragma once

#include <filesystem>

#include "experiment/scene/files/mesh_source.h"
#include "experiment/scene/making/raw_mesh.h"

namespace overt {

/// Whether this is a surface of triangles ("lh.white", "rh.inflated"), by its first bytes.
bool is_freesurfer_surface(const MeshSource& source);
/// Its triangles, in millimetres (as nibabel 5, freesurfer/io.py, reads them). Throws InputError with the
/// byte.
RawMesh read_freesurfer_surface(const MeshSource& source);

/// Labels the mesh by an annotation ("lh.aparc.annot"): a region of its colour table for each vertex, of the
/// mesh in the same order. Vertices of no region are of the part "none". Throws InputError with the byte.
void label_by_annotation(RawMesh& mesh, const std::filesystem::path& file);

/// Labels the mesh by a label ("lh.V1.label"): the vertices of one region, whose part is called as the file
/// is; all else is "body". Throws InputError with the line.
void label_by_region(RawMesh& mesh, const std::filesystem::path& file);

} // namespace overt
