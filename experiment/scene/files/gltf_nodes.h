/// Where the nodes of a glTF scene place its meshes.
#pragma once

#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "experiment/scene/files/gltf_json.h"

namespace overt {

/// A mesh as a node has it.
struct PlacedGltfMesh {
    GltfValue mesh;
    GltfValue node;
    std::string name; ///< of the node, else of the mesh, else its number
    glm::dmat4 scene_from_mesh{1.0};
};

/// All meshes of the scene that the file shows, in the order in which its nodes stand. Throws InputError for
/// nodes that go round in a circle or hang on two others, for a mesh that a skeleton bends, for a file of
/// several scenes of which none is said to be shown, and for one without meshes.
std::vector<PlacedGltfMesh> placed_gltf_meshes(const GltfValue& root);

} // namespace overt
