#include "experiment/scene/triangle_order.h"

#include <algorithm>
#include <array>
#include <tuple>

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

/// Where in a triangle each corner of the same triangle, turned, comes from.
std::array<std::uint8_t, 3> corners_from(glm::uvec3 turned_one, glm::uvec3 of) {
    std::array<std::uint8_t, 3> from{};
    for (int corner = 0; corner < 3; ++corner)
        for (std::uint8_t other = 0; other < 3; ++other)
            if (of[other] == turned_one[corner])
                from[static_cast<std::size_t>(corner)] = other;
    return from;
}

} // namespace

void order_for_drawing(Mesh& mesh, std::vector<CornersFrom>* from) {
    if (from)
        from->assign(mesh.triangles.size(), {});
    if (mesh.triangles.empty())
        return;
    const std::vector<glm::uvec3> before = from ? mesh.triangles : std::vector<glm::uvec3>();
    using Part = std::tuple<Corners, PartIndex, std::uint32_t>; // of the triangle of that number
    std::vector<Part> parts;
    parts.reserve(mesh.triangles.size());
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i)
        parts.emplace_back(turned(mesh.triangles[i]), mesh.triangle_parts[i], i);
    std::sort(parts.begin(), parts.end());

    unsigned* indices = &mesh.triangles.front().x;
    const std::size_t index_count = 3 * mesh.triangles.size();
    meshopt_optimizeVertexCache(indices, indices, index_count, mesh.positions.size());
    meshopt_optimizeOverdraw(indices, indices, index_count, &mesh.positions.front().x, mesh.positions.size(),
                             sizeof(glm::vec3), 1.05f);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const auto found =
            std::lower_bound(parts.begin(), parts.end(), Part{turned(mesh.triangles[i]), PartIndex{0}, 0});
        mesh.triangle_parts[i] = std::get<PartIndex>(*found);
        if (from) {
            const std::uint32_t old = std::get<std::uint32_t>(*found);
            (*from)[i] = {old, corners_from(mesh.triangles[i], before[old])};
        }
    }
    std::vector<glm::vec3> positions(mesh.positions.size());
    const std::size_t used =
        meshopt_optimizeVertexFetch(positions.data(), indices, index_count, mesh.positions.data(),
                                    mesh.positions.size(), sizeof(glm::vec3));
    positions.resize(used);
    mesh.positions = std::move(positions);
}

} // namespace overt
