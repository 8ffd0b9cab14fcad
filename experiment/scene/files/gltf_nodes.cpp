#include "experiment/scene/files/gltf_nodes.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "experiment/base/safe_text.h"
#include "experiment/scene/files/mesh_text.h"

namespace overt {
namespace {

glm::dvec3 triple_or(const GltfValue& of, std::string_view key, glm::dvec3 otherwise) {
    const std::optional<GltfValue> found = of.find(key);
    if (!found)
        return otherwise;
    if (found->size() != 3)
        found->fail("three numbers are expected here.");
    return {found->item(0).number(), found->item(1).number(), found->item(2).number()};
}

glm::dmat4 turn_of(const GltfValue& node) {
    const std::optional<GltfValue> rotation = node.find("rotation");
    if (!rotation)
        return glm::dmat4(1.0);
    if (rotation->size() != 4)
        rotation->fail("a quaternion of four numbers, x, y, z, w, is expected here.");
    glm::dvec4 q(rotation->item(0).number(), rotation->item(1).number(), rotation->item(2).number(),
                 rotation->item(3).number());
    const double length = glm::length(q);
    if (!(length > 1e-6) || !std::isfinite(length))
        rotation->fail("this quaternion has no length.");
    q /= length;
    const double x = q.x, y = q.y, z = q.z, w = q.w;
    // By columns.
    return {1 - 2 * (y * y + z * z),
            2 * (x * y + w * z),
            2 * (x * z - w * y),
            0,
            2 * (x * y - w * z),
            1 - 2 * (x * x + z * z),
            2 * (y * z + w * x),
            0,
            2 * (x * z + w * y),
            2 * (y * z - w * x),
            1 - 2 * (x * x + y * y),
            0,
            0,
            0,
            0,
            1};
}

glm::dmat4 parent_from(const GltfValue& node) {
    if (const std::optional<GltfValue> matrix = node.find("matrix")) {
        if (matrix->size() != 16)
            matrix->fail("sixteen numbers are expected here, by columns.");
        glm::dmat4 made;
        for (int column = 0; column < 4; ++column)
            for (int row = 0; row < 4; ++row)
                made[column][row] = matrix->item(static_cast<std::size_t>(4 * column + row)).number();
        if (made[0][3] != 0.0 || made[1][3] != 0.0 || made[2][3] != 0.0 || made[3][3] != 1.0)
            matrix->fail("the last row of a node's matrix is 0, 0, 0, 1.");
        return made;
    }
    glm::dmat4 made = turn_of(node);
    const glm::dvec3 scale = triple_or(node, "scale", glm::dvec3(1.0));
    for (int axis = 0; axis < 3; ++axis)
        made[axis] *= scale[axis];
    made[3] = glm::dvec4(triple_or(node, "translation", glm::dvec3(0.0)), 1.0);
    return made;
}

/// The nodes at which the scene begins.
std::vector<std::size_t> roots_of(const GltfValue& root, std::size_t nodes) {
    std::vector<std::size_t> roots;
    const std::optional<GltfValue> scenes = root.find("scenes");
    if (!scenes || scenes->size() == 0) {
        // Without scenes all is shown that hangs on nothing.
        std::vector<bool> hangs(nodes, false);
        for (std::size_t i = 0; i < nodes; ++i) {
            const std::optional<GltfValue> children = root.at("nodes").item(i).find("children");
            for (std::size_t child = 0; children && child < children->size(); ++child)
                if (const std::size_t index = children->item(child).whole(); index < nodes)
                    hangs[index] = true;
        }
        for (std::size_t i = 0; i < nodes; ++i)
            if (!hangs[i])
                roots.push_back(i);
        return roots;
    }
    const std::optional<GltfValue> shown = root.find("scene");
    if (!shown && scenes->size() > 1)
        scenes->fail(
            fmt::format("the file has {} scenes and does not say which is shown; export the one that is "
                        "meant.",
                        scenes->size()));
    const GltfValue scene = shown ? gltf_entry(root, "scenes", *shown) : scenes->item(0);
    if (const std::optional<GltfValue> of_scene = scene.find("nodes"))
        for (std::size_t i = 0; i < of_scene->size(); ++i) {
            gltf_entry(root, "nodes", of_scene->item(i));
            roots.push_back(of_scene->item(i).whole());
        }
    return roots;
}

std::string name_of_node(const GltfValue& node, const GltfValue& mesh, std::size_t number) {
    std::string name = node.text_or_empty("name");
    if (name.empty())
        name = mesh.text_or_empty("name");
    return name.empty() ? fmt::format("node {}", number) : printable_text(name);
}

} // namespace

std::vector<PlacedGltfMesh> placed_gltf_meshes(const GltfValue& root) {
    const std::optional<GltfValue> nodes = root.find("nodes");
    if (!nodes || nodes->size() == 0)
        root.fail("this glTF file places no mesh: it has no \"nodes\".");
    struct Waiting {
        std::size_t node;
        glm::dmat4 scene_from_parent;
    };
    std::vector<Waiting> waiting;
    for (const std::size_t node : roots_of(root, nodes->size()))
        waiting.push_back({node, glm::dmat4(1.0)});
    std::ranges::reverse(waiting);
    std::vector<bool> is_met(nodes->size(), false);
    std::vector<PlacedGltfMesh> placed;
    while (!waiting.empty()) {
        const auto [number, scene_from_parent] = waiting.back();
        waiting.pop_back();
        const GltfValue node = nodes->item(number);
        if (is_met[number])
            node.fail("this node hangs on two others, or on itself; a node hangs on one.");
        is_met[number] = true;
        const glm::dmat4 scene_from_node = scene_from_parent * parent_from(node);
        if (const std::optional<GltfValue> index = node.find("mesh")) {
            const GltfValue mesh = gltf_entry(root, "meshes", *index);
            const std::string name = name_of_node(node, mesh, number);
            if (node.find("skin"))
                node.fail(fmt::format(
                    "node {} is bent by a skeleton: pose it and apply the armature in the program "
                    "that made it, then export again.",
                    MeshText::quoted(name)));
            placed.push_back({mesh, node, name, scene_from_node});
        }
        if (const std::optional<GltfValue> children = node.find("children"))
            for (std::size_t i = children->size(); i-- > 0;) {
                gltf_entry(root, "nodes", children->item(i));
                waiting.push_back({children->item(i).whole(), scene_from_node});
            }
    }
    if (placed.empty())
        root.fail("no mesh hangs on the nodes of the scene that is shown.");
    return placed;
}

} // namespace overt
