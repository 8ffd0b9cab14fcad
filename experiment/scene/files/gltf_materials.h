/// What the triangles of a glTF file are made of.
#pragma once

#include <string>
#include <vector>

#include "experiment/scene/files/gltf_buffers.h"
#include "experiment/scene/surface_appearance.h"

namespace overt {

/// A material of the file with what the reader of triangles has to know of it.
struct GltfMaterial {
    FileMaterial look;
    float alpha = 1.0f;       ///< factor on the alpha of the colour's picture
    float least_alpha = 0.0f; ///< from which on a place is there; 0: it is opaque, whatever alpha says
    bool needs_uvs[2] = {false, false};
    std::string pointer;
};

/// The names of all materials of the file, made different where none is given.
std::vector<std::string> gltf_material_names(const GltfValue& root);

/// Reads all materials of the file with their pictures, and adds a sentence to the remarks for each thing
/// that is left aside. Throws InputError at its place for pictures that cannot be read or whose format is not
/// known.
std::vector<GltfMaterial> read_gltf_materials(const GltfValue& root, GltfBuffers& buffers,
                                              SurfaceAppearance& appearance);

} // namespace overt
