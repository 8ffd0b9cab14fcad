#include "experiment/scene/shading_normals.h"

#include <cmath>
#include <cstdint>

#include "experiment/base/parallel.h"
#include "experiment/units.h"

namespace overt {

namespace {

/// Twice the area long.
std::vector<glm::vec3> area_normals(const Mesh& mesh) {
    std::vector<glm::vec3> normals;
    normals.reserve(mesh.triangles.size());
    for (const glm::uvec3 corners : mesh.triangles) {
        const glm::dvec3 a(mesh.positions[corners.x]), b(mesh.positions[corners.y]),
            c(mesh.positions[corners.z]);
        normals.emplace_back(glm::cross(b - a, c - a));
    }
    return normals;
}

/// The triangles around each vertex, one vertex after another.
struct TrianglesOfVertices {
    std::vector<std::uint32_t> begin; ///< of each vertex's, and the end of the last
    std::vector<std::uint32_t> triangles;

    explicit TrianglesOfVertices(const Mesh& mesh)
        : begin(mesh.positions.size() + 1, 0), triangles(3 * mesh.triangles.size()) {
        for (const glm::uvec3 corners : mesh.triangles) {
            for (int corner = 0; corner < 3; ++corner)
                ++begin[corners[corner] + 1];
        }
        for (std::size_t vertex = 1; vertex < begin.size(); ++vertex)
            begin[vertex] += begin[vertex - 1];
        std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
        for (std::uint32_t triangle = 0; triangle < mesh.triangles.size(); ++triangle) {
            for (int corner = 0; corner < 3; ++corner)
                triangles[next[mesh.triangles[triangle][corner]]++] = triangle;
        }
    }
};

glm::vec3 unit_or(glm::vec3 v, glm::vec3 otherwise) {
    const float length = glm::length(v);
    return length > 0.0f ? v / length : otherwise;
}

} // namespace

std::vector<CornerNormals> corner_normals(const Mesh& mesh, double crease_deg) {
    const std::vector<glm::vec3> areas = area_normals(mesh);
    const TrianglesOfVertices around(mesh);
    const float least_cosine = static_cast<float>(std::cos(to_radians({crease_deg}).value));
    std::vector<CornerNormals> normals(mesh.triangles.size());
    constexpr std::size_t batch = 4096;
    parallel_for(static_cast<int>((normals.size() + batch - 1) / batch), [&](int index) {
        const std::size_t begin = static_cast<std::size_t>(index) * batch;
        const std::size_t end = std::min(begin + batch, normals.size());
        for (std::size_t triangle = begin; triangle < end; ++triangle) {
            const glm::vec3 own = unit_or(areas[triangle], glm::vec3(0, 0, 1));
            for (int corner = 0; corner < 3; ++corner) {
                glm::vec3 sum(0.0f);
                const std::uint32_t vertex = mesh.triangles[triangle][corner];
                for (std::uint32_t i = around.begin[vertex]; i < around.begin[vertex + 1]; ++i) {
                    const glm::vec3 other = areas[around.triangles[i]];
                    if (around.triangles[i] == triangle ||
                        glm::dot(other, own) > least_cosine * glm::length(other))
                        sum += other;
                }
                normals[triangle][static_cast<std::size_t>(corner)] = unit_or(sum, own);
            }
        }
    });
    return normals;
}

} // namespace overt
