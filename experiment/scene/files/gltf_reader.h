/// Triangle meshes in glTF 2.0, as .gltf with the files beside it or as .glb.
#pragma once

#include "experiment/scene/files/mesh_source.h"
#include "experiment/scene/making/raw_mesh.h"

namespace overt {

/// Whether the file begins as a .glb does, or as JSON, which no other format of meshes is.
bool is_gltf(const MeshSource& source);

/// Reads the triangles of the scene that is shown, as its nodes place them: coordinates of the scene, in the
/// file's metres and with +y up. Nodes are groups; what the triangles are made of are materials. With
/// MeshWanted::appearance also materials, pictures and colours.
///
/// Nothing that the file claims is believed: every offset, count and index is held against what is there
/// before anything of that size is asked for. Throws InputError with the file and the place in its JSON (a
/// pointer, RFC 6901) for what contradicts itself, leads out of its folder, cannot be shown honestly
/// (skeletons, morph targets that are on, holes) or needs an extension that is not known; it says what to do.
RawMesh read_gltf(const MeshSource& source, MeshWanted wanted);

} // namespace overt
