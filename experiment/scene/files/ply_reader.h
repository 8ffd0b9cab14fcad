/// PLY files: text or binary, in any order and type of properties.
#pragma once

#include "experiment/scene/files/mesh_source.h"
#include "experiment/scene/making/raw_mesh.h"

namespace overt {

/// Whether the file begins as PLY files do.
bool is_ply(const MeshSource& source);

/// Reads a PLY mesh: element `vertex` with x, y, z (other properties are passed over), element `face` with
/// the list vertex_indices or vertex_index, polygons cut into triangles (face_cutting.h), or element
/// `tristrips` with such a list, in which -1 begins a new strip. An integer property `part`, `part_id` or
/// `label` labels the triangles: that of the face, or else the middle one of the three corners' labels (which
/// is the one that two corners share, if two do). Lines `comment part LABEL NAME` name labels. Other elements
/// are passed over.
///
/// Throws InputError with line and column (text) or byte offset (binary) if the file is cut off or
/// contradicts itself, and for coordinates of a face that are not finite, indices out of range and faces with
/// fewer than three corners.
RawMesh read_ply(const MeshSource& source, MeshWanted wanted = MeshWanted::shape);

} // namespace overt
