/// Small closed figures for tests that need an object.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "experiment/scene/mesh.h"
#include "experiment/units.h"

namespace overt::test {

/// Appends a piece whose triangles all belong to the part of that name.
inline void add_part(Mesh& mesh, const Mesh& piece, const std::string& part) {
    auto named = std::find(mesh.part_names.begin(), mesh.part_names.end(), part);
    if (named == mesh.part_names.end())
        named = mesh.part_names.insert(named, part);
    const PartIndex index = static_cast<PartIndex>(named - mesh.part_names.begin());
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), piece.positions.begin(), piece.positions.end());
    for (const glm::uvec3& triangle : piece.triangles) {
        mesh.triangles.push_back(triangle + first);
        mesh.triangle_parts.push_back(index);
    }
}

/// Of a ball whose vertices are a pole, rings of segments, and the other pole: fronts outwards.
inline std::vector<glm::uvec3> ball_triangles(int rings, int segments) {
    std::vector<glm::uvec3> triangles;
    const auto at = [&](int ring, int segment) {
        return static_cast<std::uint32_t>(1 + (ring - 1) * segments + segment % segments);
    };
    const auto last = at(rings, 0);
    for (int segment = 0; segment < segments; ++segment) {
        triangles.emplace_back(0, at(1, segment), at(1, segment + 1));
        for (int ring = 1; ring + 1 < rings; ++ring) {
            triangles.emplace_back(at(ring, segment), at(ring + 1, segment), at(ring + 1, segment + 1));
            triangles.emplace_back(at(ring, segment), at(ring + 1, segment + 1), at(ring, segment + 1));
        }
        triangles.emplace_back(last, at(rings - 1, segment + 1), at(rings - 1, segment));
    }
    return triangles;
}

/// A ball of rings of quads with triangles at the poles: 2 * segments * (rings - 1) triangles.
inline Mesh ball(glm::dvec3 centre, double radius, int rings = 24, int segments = 48) {
    Mesh mesh;
    const auto put = [&](double polar, double azimuth) {
        mesh.positions.emplace_back(centre + radius * glm::dvec3(std::sin(polar) * std::cos(azimuth),
                                                                 std::sin(polar) * std::sin(azimuth),
                                                                 std::cos(polar)));
    };
    put(0.0, 0.0);
    for (int ring = 1; ring < rings; ++ring) {
        for (int segment = 0; segment < segments; ++segment)
            put(std::numbers::pi * ring / rings, 2.0 * std::numbers::pi * segment / segments);
    }
    put(std::numbers::pi, 0.0);
    mesh.triangles = ball_triangles(rings, segments);
    mesh.triangle_parts.assign(mesh.triangles.size(), PartIndex{0});
    mesh.part_names = {"body"};
    return mesh;
}

/// The middle of a triangle.
inline glm::dvec3 centroid(const Mesh& mesh, std::size_t triangle) {
    glm::dvec3 sum(0.0);
    for (int corner = 0; corner < 3; ++corner)
        sum += glm::dvec3(mesh.positions[mesh.triangles[triangle][corner]]);
    return sum / 3.0;
}

/// A box between two corners.
inline Mesh box(glm::dvec3 low, glm::dvec3 high) {
    Mesh mesh;
    for (int i = 0; i < 8; ++i) {
        mesh.positions.emplace_back(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z);
    }
    mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                      {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    mesh.triangle_parts.assign(mesh.triangles.size(), PartIndex{0});
    mesh.part_names = {"body"};
    return mesh;
}

/// A bust: a ball ("head") floating just above a box ("body") that stands on a wider one ("plinth"), 300 mm
/// high.
inline Mesh bust() {
    Mesh mesh;
    add_part(mesh, box({-70.0, -45.0, 40.0}, {70.0, 45.0, 190.0}), "body");
    add_part(mesh, ball({0.0, -10.0, 245.0}, 52.0), "head");
    add_part(mesh, box({-90.0, -60.0, 0.0}, {90.0, 60.0, 38.0}), "plinth");
    return mesh;
}

} // namespace overt::test
