#include "experiment/surface/surface_geometry.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "experiment/base/error.h"

namespace overt {
namespace {

// The node of each vertex: one number for each position, in the order of the vertices.
std::vector<std::uint32_t> weld(std::span<const glm::vec3> positions) {
    std::vector<std::uint32_t> order(positions.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto before = [&](std::uint32_t a, std::uint32_t b) {
        const glm::vec3 &p = positions[a], &q = positions[b];
        if (p.x != q.x)
            return p.x < q.x;
        if (p.y != q.y)
            return p.y < q.y;
        if (p.z != q.z)
            return p.z < q.z;
        return a < b;
    };
    std::sort(order.begin(), order.end(), before);
    // The first of equal positions stands for all of them.
    std::vector<std::uint32_t> first(positions.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        const bool same = i > 0 && positions[order[i]] == positions[order[i - 1]];
        first[order[i]] = same ? first[order[i - 1]] : order[i];
    }
    std::vector<std::uint32_t> node(positions.size());
    std::uint32_t nodes = 0;
    for (std::uint32_t v = 0; v < node.size(); ++v)
        node[v] = first[v] == v ? nodes++ : node[first[v]];
    return node;
}

bool names_a_node_twice(const glm::uvec3& t) { return t.x == t.y || t.y == t.z || t.z == t.x; }

// Triangles of three different nodes, each set of three once, rising.
std::vector<std::uint32_t> distinct_triangles(std::span<const glm::uvec3> corners) {
    std::vector<std::pair<std::array<std::uint32_t, 3>, std::uint32_t>> sorted;
    sorted.reserve(corners.size());
    for (std::uint32_t t = 0; t < corners.size(); ++t) {
        if (names_a_node_twice(corners[t]))
            continue;
        std::array<std::uint32_t, 3> nodes{corners[t].x, corners[t].y, corners[t].z};
        std::sort(nodes.begin(), nodes.end());
        sorted.emplace_back(nodes, t);
    }
    std::sort(sorted.begin(), sorted.end());
    std::vector<std::uint32_t> kept;
    for (std::size_t i = 0; i < sorted.size(); ++i) {
        if (i == 0 || sorted[i].first != sorted[i - 1].first)
            kept.push_back(sorted[i].second);
    }
    std::sort(kept.begin(), kept.end());
    return kept;
}

} // namespace

SurfaceGeometry::SurfaceGeometry(const Mesh& mesh, double mm_per_unit)
    : node_of_vertex_(weld(mesh.positions)) {
    OVERT_EXPECTS(mm_per_unit > 0.0);
    for (std::uint32_t v = 0; v < node_of_vertex_.size(); ++v) {
        if (node_of_vertex_[v] == positions_mm_.size())
            positions_mm_.push_back(mm_per_unit * glm::dvec3(mesh.positions[v]));
    }
    corners_.reserve(mesh.triangles.size());
    for (const glm::uvec3& t : mesh.triangles)
        corners_.emplace_back(node_of_vertex_[t.x], node_of_vertex_[t.y], node_of_vertex_[t.z]);
    std::vector<glm::uvec3> distinct;
    triangles_begin_.assign(node_count() + 1, 0);
    const std::vector<std::uint32_t> kept = distinct_triangles(corners_);
    for (const std::uint32_t t : kept) {
        distinct.push_back(corners_[t]);
        for (int corner = 0; corner < 3; ++corner)
            ++triangles_begin_[corners_[t][corner] + 1];
    }
    std::partial_sum(triangles_begin_.begin(), triangles_begin_.end(), triangles_begin_.begin());
    triangles_.resize(3 * kept.size());
    std::vector<std::size_t> next(triangles_begin_.begin(), triangles_begin_.end());
    for (const std::uint32_t t : kept) {
        for (int corner = 0; corner < 3; ++corner)
            triangles_[next[corners_[t][corner]]++] = t;
    }

    areas_mm2_.assign(node_count(), 0.0);
    std::vector<std::uint64_t> edges;
    edges.reserve(6 * distinct.size());
    for (const glm::uvec3& t : distinct) {
        const glm::dvec3 &a = positions_mm_[t.x], &b = positions_mm_[t.y], &c = positions_mm_[t.z];
        const double area = 0.5 * glm::length(glm::cross(b - a, c - a));
        for (int corner = 0; corner < 3; ++corner) {
            const std::uint64_t from = t[corner], to = t[(corner + 1) % 3];
            areas_mm2_[from] += area / 3.0;
            edges.push_back(from << 32 | to);
            edges.push_back(to << 32 | from);
        }
    }
    total_area_mm2_ = std::accumulate(areas_mm2_.begin(), areas_mm2_.end(), 0.0);

    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    neighbours_begin_.assign(node_count() + 1, 0);
    neighbours_.reserve(edges.size());
    for (const std::uint64_t edge : edges) {
        ++neighbours_begin_[(edge >> 32) + 1];
        neighbours_.push_back(static_cast<std::uint32_t>(edge));
    }
    std::partial_sum(neighbours_begin_.begin(), neighbours_begin_.end(), neighbours_begin_.begin());
}

const IntrinsicTriangulation& SurfaceGeometry::triangulation() const {
    std::call_once(triangulated_, [this] {
        std::vector<glm::uvec3> distinct;
        for (const std::uint32_t t : distinct_triangles(corners_))
            distinct.push_back(corners_[t]);
        triangulation_ = IntrinsicTriangulation(positions_mm_, distinct);
    });
    return triangulation_;
}

std::span<const std::uint32_t> SurfaceGeometry::neighbours(std::uint32_t node) const {
    return std::span(neighbours_)
        .subspan(neighbours_begin_[node], neighbours_begin_[node + 1] - neighbours_begin_[node]);
}

std::span<const std::uint32_t> SurfaceGeometry::triangles_at(std::uint32_t node) const {
    return std::span(triangles_)
        .subspan(triangles_begin_[node], triangles_begin_[node + 1] - triangles_begin_[node]);
}

glm::dvec3 SurfaceGeometry::position_mm(const SurfacePlace& place) const {
    const glm::uvec3& nodes = corners_[place.triangle];
    return place.barycentric.x * positions_mm_[nodes.x] + place.barycentric.y * positions_mm_[nodes.y] +
           place.barycentric.z * positions_mm_[nodes.z];
}

std::vector<double> SurfaceGeometry::vertex_areas_mm2() const {
    std::vector<double> shares(node_count(), 0.0);
    for (const std::uint32_t node : node_of_vertex_)
        shares[node] += 1.0;
    std::vector<double> areas(vertex_count());
    for (std::size_t v = 0; v < areas.size(); ++v)
        areas[v] = areas_mm2_[node_of_vertex_[v]] / shares[node_of_vertex_[v]];
    return areas;
}

std::vector<double> SurfaceGeometry::at_vertices(std::span<const double> of_nodes) const {
    OVERT_EXPECTS(of_nodes.size() == node_count());
    std::vector<double> values(vertex_count());
    for (std::size_t v = 0; v < values.size(); ++v)
        values[v] = of_nodes[node_of_vertex_[v]];
    return values;
}

} // namespace overt
