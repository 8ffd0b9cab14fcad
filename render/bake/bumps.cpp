#include "render/bake/bumps.h"

#include <algorithm>
#include <cmath>

#include "experiment/base/parallel.h"

namespace overt {

namespace {

/// A triangle as the picture of its normals has it.
struct PlacedTriangle {
    std::array<glm::dvec2, 3> uv;
    glm::dvec3 tangent{0.0}; ///< along which u grows; 0: there is none
    float side = 0.0f;
};

std::vector<PlacedTriangle> placed_triangles(const SurfaceAppearance& appearance, const Mesh& mesh) {
    std::vector<PlacedTriangle> placed(mesh.triangles.size());
    for (std::uint32_t i = 0; i < placed.size(); ++i) {
        const SurfacePlacement& picture = appearance.material_of(i).normal_picture;
        if (picture.picture < 0)
            continue;
        const std::vector<CornerUvs>& uvs = appearance.uvs[static_cast<std::size_t>(picture.uv_set)];
        if (uvs.empty())
            continue;
        PlacedTriangle& triangle = placed[i];
        for (std::size_t corner = 0; corner < 3; ++corner)
            triangle.uv[corner] = picture.place_of(glm::dvec2(uvs[i][corner]));
        const glm::dvec2 d1 = triangle.uv[1] - triangle.uv[0], d2 = triangle.uv[2] - triangle.uv[0];
        const double area = d1.x * d2.y - d2.x * d1.y;
        const glm::uvec3 corners = mesh.triangles[i];
        const glm::dvec3 a(mesh.positions[corners.x]);
        const glm::dvec3 e1 = glm::dvec3(mesh.positions[corners.y]) - a,
                         e2 = glm::dvec3(mesh.positions[corners.z]) - a;
        const glm::dvec3 along = (d2.y * e1 - d1.y * e2) * (area < 0.0 ? -1.0 : 1.0);
        const double length = glm::length(along);
        if (area == 0.0 || !(length > 0.0))
            continue;
        triangle.tangent = along / length;
        triangle.side = area < 0.0 ? 1.0f : -1.0f; // v falls upwards
    }
    return placed;
}

/// The corners around each vertex, by 3 triangle + corner, one vertex after another.
struct CornersOfVertices {
    std::vector<std::uint32_t> begin, corners;

    explicit CornersOfVertices(const Mesh& mesh)
        : begin(mesh.positions.size() + 1, 0), corners(3 * mesh.triangles.size()) {
        for (const glm::uvec3 triangle : mesh.triangles)
            for (int corner = 0; corner < 3; ++corner)
                ++begin[triangle[corner] + 1];
        for (std::size_t vertex = 1; vertex < begin.size(); ++vertex)
            begin[vertex] += begin[vertex - 1];
        std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
        for (std::uint32_t i = 0; i < corners.size(); ++i)
            corners[next[mesh.triangles[i / 3][static_cast<int>(i % 3)]]++] = i;
    }
};

double angle_at(const Mesh& mesh, std::uint32_t triangle, std::uint32_t corner) {
    const glm::uvec3 corners = mesh.triangles[triangle];
    const auto place = [&](std::uint32_t of) {
        return glm::dvec3(mesh.positions[corners[static_cast<int>(of % 3)]]);
    };
    const glm::dvec3 at = place(corner), to_next = place(corner + 1) - at, to_last = place(corner + 2) - at;
    return std::atan2(glm::length(glm::cross(to_next, to_last)), glm::dot(to_next, to_last));
}

/// Of a direction, what lies in the surface of a normal; 0 if nothing does.
glm::dvec3 along_surface(glm::dvec3 direction, glm::dvec3 normal) {
    const glm::dvec3 flat = direction - glm::dot(direction, normal) * normal;
    const double length = glm::length(flat);
    return length > 1e-9 ? flat / length : glm::dvec3(0.0);
}

} // namespace

std::vector<CornerTangents> corner_tangents(const SurfaceAppearance& appearance, const Mesh& mesh,
                                            std::span<const CornerNormals> normals) {
    const std::vector<PlacedTriangle> placed = placed_triangles(appearance, mesh);
    const CornersOfVertices around(mesh);
    std::vector<CornerTangents> tangents(mesh.triangles.size());
    constexpr std::size_t batch = 4096;
    parallel_for(static_cast<int>((tangents.size() + batch - 1) / batch), [&](int index) {
        const std::size_t begin = static_cast<std::size_t>(index) * batch;
        for (std::size_t i = begin; i < std::min(begin + batch, tangents.size()); ++i) {
            const PlacedTriangle& own = placed[i];
            for (std::size_t corner = 0; own.side != 0.0f && corner < 3; ++corner) {
                const glm::vec3 normal = normals[i][corner];
                glm::dvec3 sum(0.0);
                const std::uint32_t vertex = mesh.triangles[i][static_cast<int>(corner)];
                for (std::uint32_t at = around.begin[vertex]; at < around.begin[vertex + 1]; ++at) {
                    const std::uint32_t other = around.corners[at] / 3, its_corner = around.corners[at] % 3;
                    const PlacedTriangle& neighbour = placed[other];
                    constexpr float same = 1e-3f;
                    if (neighbour.side != own.side || neighbour.uv[its_corner] != own.uv[corner] ||
                        glm::length(normals[other][its_corner] - normal) > same)
                        continue;
                    sum += angle_at(mesh, other, its_corner) *
                           along_surface(neighbour.tangent, glm::dvec3(normal));
                }
                glm::dvec3 tangent = along_surface(sum, glm::dvec3(normal));
                if (tangent == glm::dvec3(0.0))
                    tangent = along_surface(own.tangent, glm::dvec3(normal));
                tangents[i][corner] = glm::vec4(glm::vec3(tangent), own.side);
            }
        }
    });
    return tangents;
}

Bumps::Bumps(std::shared_ptr<const SurfaceAppearance> appearance, const Mesh& mesh,
             std::span<const CornerNormals> normals)
    : appearance_(std::move(appearance)), tangents_(corner_tangents(*appearance_, mesh, normals)) {}

glm::vec3 Bumps::normal_at(const SurfaceHit& hit) const {
    const glm::vec3 normal = hit.shading_normal;
    const glm::vec3 bump = bump_at(*appearance_, hit.triangle, hit.place);
    if (bump == glm::vec3(0.0f, 0.0f, 1.0f))
        return normal;
    const CornerTangents& corners = tangents_[hit.triangle];
    const glm::vec3 mean = (1.0f - hit.place.x - hit.place.y) * glm::vec3(corners[0]) +
                           hit.place.x * glm::vec3(corners[1]) + hit.place.y * glm::vec3(corners[2]);
    const glm::vec3 flat = mean - glm::dot(mean, normal) * normal;
    const float length = glm::length(flat);
    if (!(length > 1e-6f))
        return normal;
    const glm::vec3 tangent = flat / length, bitangent = corners[0].w * glm::cross(normal, tangent);
    return glm::normalize(bump.x * tangent + bump.y * bitangent + bump.z * normal);
}

} // namespace overt
