/// OBJ files (Wavefront): the polygons of a text mesh, and its groups as parts.
#pragma once

#include "experiment/scene/files/mesh_source.h"
#include "experiment/scene/making/raw_mesh.h"

namespace overt {

/// Whether the first statement of the file is one with which OBJ files begin.
bool is_obj(const MeshSource& source);

/// Reads `v` and `f` (corners as v, v/vt, v//vn or v/vt/vn, from 1, or negative from the last vertex back),
/// with polygons cut into triangles (face_cutting.h). When the faces belong to more than one object or group,
/// each name given by the last `o` or `g` before a face becomes a part; faces before the first name are the
/// part "body". `usemtl` names what triangles are made of. With MeshWanted::appearance `vt`, `mtllib` and
/// colours behind coordinates are read, too (obj_look.h, mtl_reader.h). All other statements are passed over.
/// A backslash joins a line with the next.
///
/// Throws InputError with line and column for coordinates of a face that are no finite numbers, indices out
/// of range and faces with fewer than three corners, and if there are no faces.
RawMesh read_obj(const MeshSource& source, MeshWanted wanted = MeshWanted::shape);

} // namespace overt
