#include "render/stimulus/mesh_buffers.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "experiment/base/error.h"
#include "experiment/base/parallel.h"
#include "experiment/scene/mesh_topology.h"
#include "experiment/scene/ray_caster.h"

namespace overt {

namespace {

// Rays of a vertex: as many as all take a second or two, and enough that the share of a few of them is smooth
// once neighbours are joined.
constexpr double rays_in_all = 6e6;
constexpr int fewest_rays = 48, most_rays = 512;
/// Vertices nearer than this share of the mesh's diagonal are joined, this often.
constexpr double joined_share = 0.01;
constexpr int joining_steps = 12;

int rays_of_vertex(const Mesh& mesh) {
    return std::clamp(
        static_cast<int>(rays_in_all / static_cast<double>(std::max<std::size_t>(mesh.positions.size(), 1))),
        fewest_rays, most_rays);
}

/// Takes the grain out of what was found by few rays: means over neighbours that face the same way.
void join_neighbours(const Mesh& mesh, const std::vector<glm::vec3>& normals,
                     std::vector<glm::vec4>& openness) {
    const double reach = joined_share * mesh.bounds().diagonal();
    std::vector<glm::dvec4> sums(openness.size());
    std::vector<double> weights(openness.size());
    for (int step = 0; step < joining_steps; ++step) {
        for (std::size_t i = 0; i < openness.size(); ++i) {
            sums[i] = glm::dvec4(openness[i]);
            weights[i] = 1.0;
        }
        for (const glm::uvec3& triangle : mesh.triangles) {
            for (int corner = 0; corner < 3; ++corner) {
                const std::uint32_t a = triangle[corner], b = triangle[(corner + 1) % 3];
                const double apart =
                    glm::distance(glm::dvec3(mesh.positions[a]), glm::dvec3(mesh.positions[b])) / reach;
                const double alike = std::max(0.0, glm::dot(glm::dvec3(normals[a]), glm::dvec3(normals[b])));
                // Each edge is met from both of its triangles.
                const double weight = 0.5 * std::pow(alike, 8.0) * std::exp(-0.5 * apart * apart);
                sums[a] += weight * glm::dvec4(openness[b]);
                sums[b] += weight * glm::dvec4(openness[a]);
                weights[a] += weight;
                weights[b] += weight;
            }
        }
        for (std::size_t i = 0; i < openness.size(); ++i)
            openness[i] = glm::vec4(sums[i] / weights[i]);
    }
}

std::vector<glm::vec3> positions_about(const Mesh& mesh, glm::dvec3 centre) {
    std::vector<glm::vec3> positions;
    positions.reserve(mesh.positions.size());
    for (const glm::vec3& position : mesh.positions)
        positions.emplace_back(glm::dvec3(position) - centre);
    return positions;
}

} // namespace

std::vector<glm::vec4> openness_of_vertices(const Mesh& mesh) {
    const RayCaster rays(mesh);
    const std::vector<glm::vec3> normals = mesh.vertex_normals();
    const double lift = 1e-4 * mesh.bounds().diagonal();
    std::vector<glm::vec4> openness(mesh.positions.size());
    const int openness_rays = rays_of_vertex(mesh);
    constexpr int block = 4096;
    parallel_for(static_cast<int>((openness.size() + block - 1) / block), [&](int which) {
        const std::size_t first = static_cast<std::size_t>(which) * block;
        for (std::size_t i = first; i < std::min(first + block, openness.size()); ++i) {
            const glm::dvec3 normal(normals[i]);
            const glm::dvec3 side = std::abs(normal.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
            const glm::dvec3 tangent = glm::normalize(glm::cross(side, normal));
            const glm::dvec3 bitangent = glm::cross(normal, tangent);
            // Turned anew for each vertex: neighbours with the same directions would err alike, which is seen
            // as stripes. Steps of the golden ratio are spread evenly.
            const double first_turn =
                2.0 * std::numbers::pi * std::fmod(0.6180339887498949 * static_cast<double>(i), 1.0);
            glm::dvec3 open_direction(0.0);
            int open = 0;
            for (int ray = 0; ray < openness_rays; ++ray) {
                // Cosine-weighted spiral over the hemisphere: equal areas of the disc, golden-angle turns.
                const double radius = std::sqrt((ray + 0.5) / openness_rays);
                const double turn = first_turn + ray * std::numbers::pi * (3.0 - std::sqrt(5.0));
                const glm::dvec3 direction = radius * std::cos(turn) * tangent +
                                             radius * std::sin(turn) * bitangent +
                                             std::sqrt(1.0 - radius * radius) * normal;
                if (rays.first_hit({glm::dvec3(mesh.positions[i]) + lift * normal, direction}))
                    continue;
                open_direction += direction;
                ++open;
            }
            openness[i] = glm::vec4(glm::vec3(open_direction / static_cast<double>(openness_rays)),
                                    static_cast<float>(open) / static_cast<float>(openness_rays));
        }
    });
    join_neighbours(mesh, normals, openness);
    return openness;
}

MeshBuffers::MeshBuffers(const GlContext& context, const Mesh& mesh) : MeshBuffers(context, mesh, {}) {}

MeshBuffers::MeshBuffers(const GlContext& context, const Mesh& mesh, std::span<const glm::vec4> openness)
    : context_(&context), array_(context), index_count_(static_cast<GLsizei>(mesh.triangles.size() * 3)),
      centre_(mesh.bounds().centre()), openness_(openness.begin(), openness.end()) {
    OVERT_EXPECTS(openness.empty() || openness.size() == mesh.positions.size());
    const GladGLContext& gl = context.gl();
    array_.bind();
    const auto attribute = [&](GLuint index, GLint components, std::span<const std::byte> bytes) {
        buffers_.emplace_back(context, GL_ARRAY_BUFFER, bytes, GL_STATIC_DRAW);
        gl.EnableVertexAttribArray(index);
        gl.VertexAttribPointer(index, components, GL_FLOAT, GL_FALSE, 0, nullptr);
    };
    const std::vector<glm::vec3> positions = positions_about(mesh, centre_);
    attribute(0, 3, std::as_bytes(std::span(positions)));
    if (!openness.empty()) {
        is_closed_ = count_edges(mesh.triangles, mesh.positions.size()).bounds_volume();
        const std::vector<glm::vec3> normals = mesh.vertex_normals();
        attribute(1, 3, std::as_bytes(std::span(normals)));
        attribute(2, 4, std::as_bytes(openness));
    }
    buffers_.emplace_back(context, GL_ELEMENT_ARRAY_BUFFER, std::as_bytes(std::span(mesh.triangles)),
                          GL_STATIC_DRAW);
}

void MeshBuffers::draw() const {
    array_.bind();
    context_->gl().VertexAttrib3f(4, 1.0f, 1.0f, 1.0f); // no colours of corners
    context_->gl().DrawElements(GL_TRIANGLES, index_count_, GL_UNSIGNED_INT, nullptr);
}

} // namespace overt
