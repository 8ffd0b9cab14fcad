#include "experiment/scene/triangle_order.h"

#include <algorithm>
#include <array>

#include <meshoptimizer.h>

namespace overt {

namespace {

using Corners = std::array<unsigned, 3>;

/// The corners, turned so that the smallest is first: meshoptimizer may turn a triangle but keeps its front.
Corners turned(glm::uvec3 t) {
    Corners corners{t.x, t.y, t.z};
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    return corners;
}

} // namespace

void order_for_drawing(Mesh& mesh) {
    if (mesh.triangles.empty())
        return;
    std::vector<std::pair<Corners, PartIndex>> parts;
    parts.reserve(mesh.triangles.size());
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        parts.emplace_back(turned(mesh.triangles[i]), mesh.triangle_parts[i]);
    std::sort(parts.begin(), parts.end());

    unsigned* indices = &mesh.triangles.front().x;
    const std::size_t index_count = 3 * mesh.triangles.size();
    meshopt_optimizeVertexCache(indices, indices, index_count, mesh.positions.size());
    meshopt_optimizeOverdraw(indices, indices, index_count, &mesh.positions.front().x, mesh.positions.size(),
                             sizeof(glm::vec3), 1.05f);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const auto found =
            std::lower_bound(parts.begin(), parts.end(), std::pair{turned(mesh.triangles[i]), PartIndex{0}});
        mesh.triangle_parts[i] = found->second;
    }
    std::vector<glm::vec3> positions(mesh.positions.size());
    const std::size_t used =
        meshopt_optimizeVertexFetch(positions.data(), indices, index_count, mesh.positions.data(),
                                    mesh.positions.size(), sizeof(glm::vec3));
    positions.resize(used);
    mesh.positions = std::move(positions);
}

} // namespace overt
