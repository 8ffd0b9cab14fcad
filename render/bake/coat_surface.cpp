#include "render/bake/coat_surface.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "experiment/base/parallel.h"
#include "render/image/lattice_noise.h"

namespace overt {

namespace {

/// A mesh with the normals of its vertices, while it is divided.
struct DividedMesh {
    Mesh mesh;
    std::vector<glm::vec3> normals;
};

/// Each triangle becomes four.
DividedMesh divided(const DividedMesh& coarse) {
    DividedMesh fine;
    fine.mesh.positions = coarse.mesh.positions;
    fine.normals = coarse.normals;
    std::unordered_map<std::uint64_t, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
        const std::uint64_t edge = (std::uint64_t{std::min(a, b)} << 32) | std::max(a, b);
        const auto [found, is_new] =
            middles.try_emplace(edge, static_cast<std::uint32_t>(fine.mesh.positions.size()));
        if (is_new) {
            fine.mesh.positions.push_back(0.5f * (coarse.mesh.positions[a] + coarse.mesh.positions[b]));
            const glm::vec3 sum = coarse.normals[a] + coarse.normals[b];
            fine.normals.push_back(glm::dot(sum, sum) > 1e-6f ? glm::normalize(sum) : coarse.normals[a]);
        }
        return found->second;
    };
    for (const glm::uvec3 t : coarse.mesh.triangles) {
        const std::uint32_t ab = middle(t.x, t.y), bc = middle(t.y, t.z), ca = middle(t.z, t.x);
        for (const glm::uvec3 part : {glm::uvec3(t.x, ab, ca), {ab, t.y, bc}, {ca, bc, t.z}, {ab, bc, ca}})
            fine.mesh.triangles.push_back(part);
    }
    return fine;
}

double mean_edge(const Mesh& mesh) {
    double sum = 0.0;
    for (const glm::uvec3 t : mesh.triangles) {
        const glm::vec3 &a = mesh.positions[t.x], &b = mesh.positions[t.y], &c = mesh.positions[t.z];
        sum += static_cast<double>(glm::distance(a, b) + glm::distance(b, c) + glm::distance(c, a));
    }
    return sum / (3.0 * static_cast<double>(mesh.triangles.size()));
}

} // namespace

double stucco(glm::dvec3 place, std::uint64_t seed) {
    // Broad bumps with finer ones on them, turned against the lattice so that no row of it can be seen. Noise
    // of this kind reaches about ±0.9 with a standard deviation of about 0.22; the factor brings nearly all
    // of it within ±1/2.
    constexpr double finer = 2.17, weight = 0.35;
    const glm::dvec3 turned(0.36 * place.x + 0.48 * place.y - 0.8 * place.z, -0.8 * place.x + 0.6 * place.y,
                            0.48 * place.x + 0.64 * place.y + 0.6 * place.z);
    return 0.75 * (lattice_noise(turned, seed) + weight * lattice_noise(finer * turned, mixed_bits(seed)));
}

Mesh coat_over(const Mesh& body, const CoatShape& shape) {
    constexpr std::size_t most_triangles = 2'000'000;
    DividedMesh coat{body, body.vertex_normals()};
    while (mean_edge(coat.mesh) > 0.25 * shape.bump_width && 4 * coat.mesh.triangles.size() <= most_triangles)
        coat = divided(coat);
    const glm::dvec3 centre = body.bounds().centre();
    constexpr std::size_t batch = 8192;
    const std::size_t vertices = coat.mesh.positions.size();
    parallel_for(static_cast<int>((vertices + batch - 1) / batch), [&](int index) {
        const std::size_t begin = static_cast<std::size_t>(index) * batch;
        for (std::size_t i = begin; i < std::min(begin + batch, vertices); ++i) {
            const glm::dvec3 position(coat.mesh.positions[i]);
            const double bump =
                shape.bump_height * stucco((position - centre) / shape.bump_width, shape.seed);
            const double thickness = std::max(shape.thickness + bump, 0.1 * shape.thickness);
            coat.mesh.positions[i] = glm::vec3(position + thickness * glm::dvec3(coat.normals[i]));
        }
    });
    coat.mesh.triangle_parts.clear();
    return std::move(coat.mesh);
}

} // namespace overt
