/// Surfaces on which distances and heat are known.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <vector>

#include "experiment/scene/mesh.h"
#include "experiment/surface/surface_geometry.h"

namespace overt::test {

/// A square from -half to +half in x and y at the given height, in n x n squares of two triangles. `skew`
/// shifts each row against the one before by that share of a square, which makes the triangles obtuse.
inline Mesh flat_square(double half, int n, double height = 0.0, double skew = 0.0) {
    Mesh mesh;
    const int middle = n / 2;
    for (int row = 0; row <= n; ++row) {
        for (int column = 0; column <= n; ++column)
            mesh.positions.emplace_back(half * (2.0 * (column + skew * (row - middle)) / n - 1.0),
                                        half * (2.0 * row / n - 1.0), height);
    }
    const auto at = [n](int row, int column) { return static_cast<std::uint32_t>(row * (n + 1) + column); };
    for (int row = 0; row < n; ++row) {
        for (int column = 0; column < n; ++column) {
            mesh.triangles.emplace_back(at(row, column), at(row, column + 1), at(row + 1, column + 1));
            mesh.triangles.emplace_back(at(row, column), at(row + 1, column + 1), at(row + 1, column));
        }
    }
    mesh.triangle_parts.assign(mesh.triangles.size(), PartIndex{0});
    mesh.part_names = {"body"};
    return mesh;
}

/// A sphere about the origin: an icosahedron whose triangles were each cut into four, `times` times.
inline Mesh icosphere(double radius, int times) {
    const double g = std::numbers::phi;
    std::vector<glm::dvec3> points{{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                                   {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
    for (glm::dvec3& point : points)
        point = glm::normalize(point);
    std::vector<glm::uvec3> triangles{{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                      {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                      {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                      {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
    for (int i = 0; i < times; ++i) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
        const auto middle = [&](std::uint32_t a, std::uint32_t b) {
            const auto [found, is_new] =
                middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(points.size()));
            if (is_new)
                points.push_back(glm::normalize(points[a] + points[b]));
            return found->second;
        };
        std::vector<glm::uvec3> finer;
        for (const glm::uvec3& t : triangles) {
            const std::uint32_t a = middle(t.x, t.y), b = middle(t.y, t.z), c = middle(t.z, t.x);
            finer.insert(finer.end(), {{t.x, a, c}, {t.y, b, a}, {t.z, c, b}, {a, b, c}});
        }
        triangles = std::move(finer);
    }
    Mesh mesh;
    for (const glm::dvec3& point : points)
        mesh.positions.emplace_back(radius * point);
    mesh.triangles = std::move(triangles);
    mesh.triangle_parts.assign(mesh.triangles.size(), PartIndex{0});
    mesh.part_names = {"body"};
    return mesh;
}

/// The same surface with vertices of its own for each triangle, as an STL file has them.
inline Mesh with_loose_triangles(const Mesh& mesh) {
    Mesh loose = mesh;
    loose.positions.clear();
    for (glm::uvec3& t : loose.triangles) {
        for (int k = 0; k < 3; ++k) {
            loose.positions.push_back(mesh.positions[t[k]]);
            t[k] = static_cast<std::uint32_t>(loose.positions.size() - 1);
        }
    }
    return loose;
}

/// The corner k of a triangle as a place.
inline SurfacePlace corner_place(std::uint32_t triangle, int corner) {
    SurfacePlace place{triangle, glm::dvec3(0.0)};
    place.barycentric[corner] = 1.0;
    return place;
}

/// Some triangle at the vertex, and the vertex's place in it.
inline SurfacePlace place_of_vertex(const Mesh& mesh, std::uint32_t vertex) {
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        for (int corner = 0; corner < 3; ++corner) {
            if (mesh.triangles[t][corner] == vertex)
                return corner_place(t, corner);
        }
    }
    return {};
}

/// The sum of density times area.
inline double mass_of(const std::vector<double>& density, const SurfaceGeometry& geometry) {
    const std::vector<double> areas = geometry.vertex_areas_mm2();
    double mass = 0.0;
    for (std::size_t v = 0; v < areas.size(); ++v)
        mass += density[v] * areas[v];
    return mass;
}

/// Pieces of a surface that hang together by edges, numbered by their first node.
struct Pieces {
    std::vector<std::size_t> of_node;
    std::size_t count = 0;
};
inline Pieces pieces_of(const SurfaceGeometry& geometry) {
    constexpr auto none = ~std::size_t{0};
    Pieces pieces{std::vector(geometry.node_count(), none), 0};
    for (std::uint32_t first = 0; first < geometry.node_count(); ++first) {
        if (pieces.of_node[first] != none)
            continue;
        std::vector<std::uint32_t> open{first};
        while (!open.empty()) {
            const std::uint32_t node = open.back();
            open.pop_back();
            pieces.of_node[node] = pieces.count;
            for (const std::uint32_t next : geometry.neighbours(node))
                if (pieces.of_node[next] == none)
                    open.push_back(next);
        }
        ++pieces.count;
    }
    return pieces;
}

} // namespace overt::test
