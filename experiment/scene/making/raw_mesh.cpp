#include "experiment/scene/making/raw_mesh.h"

#include <algorithm>

namespace overt {
namespace {

bool has_place(const glm::dvec3& position) {
    return is_coordinate(position.x) && is_coordinate(position.y) && is_coordinate(position.z);
}

} // namespace

std::optional<std::size_t> first_used_without_place(const RawMesh& mesh) {
    if (std::ranges::all_of(mesh.positions, has_place))
        return std::nullopt;
    std::optional<std::size_t> first;
    for (const glm::uvec3& triangle : mesh.triangles) {
        for (int corner = 0; corner < 3; ++corner) {
            const std::size_t vertex = triangle[corner];
            if (!has_place(mesh.positions[vertex]) && (!first || vertex < *first))
                first = vertex;
        }
    }
    return first;
}

UnusedVertices drop_unused_vertices(RawMesh& mesh) {
    std::vector<bool> is_used(mesh.positions.size(), false);
    for (const glm::uvec3& triangle : mesh.triangles)
        is_used[triangle.x] = is_used[triangle.y] = is_used[triangle.z] = true;
    UnusedVertices unused;
    std::vector<std::uint32_t> index_of(mesh.positions.size());
    std::uint32_t kept = 0;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        if (is_used[i]) {
            mesh.positions[kept] = mesh.positions[i];
            index_of[i] = kept++;
        } else {
            ++(has_place(mesh.positions[i]) ? unused.with_place : unused.without_place);
        }
    }
    if (kept == mesh.positions.size())
        return unused;
    mesh.positions.resize(kept);
    for (glm::uvec3& triangle : mesh.triangles)
        triangle = {index_of[triangle.x], index_of[triangle.y], index_of[triangle.z]};
    return unused;
}

} // namespace overt
