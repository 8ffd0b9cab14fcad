/// How open a surface is to the light around it.
#include "render/stimulus/mesh_buffers.h"

#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

using namespace overt;

namespace {

constexpr int rings = 90, segments = 180;

/// A ball of radius 1 about the origin, over a floor that reaches as good as everywhere.
Mesh ball_over_floor(double floor_z) {
    Mesh mesh;
    for (int ring = 1; ring < rings; ++ring) {
        for (int segment = 0; segment < segments; ++segment) {
            const double polar = std::numbers::pi * ring / rings,
                         azimuth = 2.0 * std::numbers::pi * segment / segments;
            mesh.positions.emplace_back(std::sin(polar) * std::cos(azimuth),
                                        std::sin(polar) * std::sin(azimuth), std::cos(polar));
        }
    }
    const auto at = [](int ring, int segment) {
        return static_cast<std::uint32_t>((ring - 1) * segments + segment % segments);
    };
    for (int ring = 1; ring + 1 < rings; ++ring) {
        for (int segment = 0; segment < segments; ++segment) {
            mesh.triangles.emplace_back(at(ring, segment), at(ring + 1, segment), at(ring + 1, segment + 1));
            mesh.triangles.emplace_back(at(ring, segment), at(ring + 1, segment + 1), at(ring, segment + 1));
        }
    }
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const glm::vec2 corner : {glm::vec2(-60, -60), {60, -60}, {60, 60}, {-60, 60}})
        mesh.positions.emplace_back(corner, floor_z);
    mesh.triangles.emplace_back(first, first + 1, first + 2);
    mesh.triangles.emplace_back(first, first + 2, first + 3);
    mesh.triangle_parts.assign(mesh.triangles.size(), PartIndex{0});
    mesh.part_names = {"body"};
    return mesh;
}

} // namespace

TEST_CASE("a ball over a floor is open by (1 + n.z) / 2 everywhere, without a grain", "[unit]") {
    const Mesh mesh = ball_over_floor(-1.5);
    const std::vector<glm::vec4> openness = openness_of_vertices(mesh);
    double largest_grain = 0.0;
    for (int ring = 5; ring < rings - 5; ++ring) {
        // The floor ends a degree below the horizon.
        const double expected = 0.5 * (1.0 + std::cos(std::numbers::pi * ring / rings));
        double sum = 0.0, squares = 0.0;
        for (int segment = 0; segment < segments; ++segment) {
            const double open = double{openness[static_cast<std::size_t>((ring - 1) * segments + segment)].w};
            CHECK(open == Approx(expected).margin(0.02));
            sum += open;
            squares += open * open;
        }
        // On a ring all vertices are alike.
        const double mean = sum / segments;
        largest_grain = std::max(largest_grain, std::sqrt(std::max(0.0, squares / segments - mean * mean)));
    }
    CAPTURE(largest_grain);
    CHECK(largest_grain < 0.004);
}

TEST_CASE("a floor before a wall grows lighter without stripes", "[unit]") {
    // The floor a fine grid, its rows along the wall; both face each other.
    constexpr int rows = 90, columns = 60;
    constexpr double step = 0.05;
    Mesh mesh;
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column)
            mesh.positions.emplace_back(step * (row + 1), step * (column - columns / 2), 0.0);
    for (int row = 0; row + 1 < rows; ++row) {
        for (int column = 0; column + 1 < columns; ++column) {
            const auto at = [&](int r, int c) { return static_cast<std::uint32_t>(r * columns + c); };
            mesh.triangles.emplace_back(at(row, column), at(row + 1, column), at(row + 1, column + 1));
            mesh.triangles.emplace_back(at(row, column), at(row + 1, column + 1), at(row, column + 1));
        }
    }
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const glm::vec2 corner : {glm::vec2(-4, 0), {4, 0}, {4, 3}, {-4, 3}})
        mesh.positions.emplace_back(0.0, corner.x, corner.y);
    mesh.triangles.emplace_back(first, first + 1, first + 2);
    mesh.triangles.emplace_back(first, first + 2, first + 3);
    mesh.triangle_parts.assign(mesh.triangles.size(), PartIndex{0});
    mesh.part_names = {"body"};
    const std::vector<glm::vec4> openness = openness_of_vertices(mesh);
    std::vector<double> means;
    for (int row = 10; row + 10 < rows; ++row) {
        double sum = 0.0;
        for (int column = 15; column < columns - 15; ++column)
            sum += double{openness[static_cast<std::size_t>(row * columns + column)].w};
        means.push_back(sum / (columns - 30));
    }
    // What grows smoothly has no differences of the fourth order; a stripe has.
    double squares = 0.0;
    for (std::size_t i = 2; i + 2 < means.size(); ++i) {
        const double stripe =
            means[i - 2] - 4.0 * means[i - 1] + 6.0 * means[i] - 4.0 * means[i + 1] + means[i + 2];
        squares += stripe * stripe;
    }
    const double stripes = std::sqrt(squares / static_cast<double>(means.size() - 4));
    CAPTURE(stripes);
    CHECK(stripes < 3e-5);
}
