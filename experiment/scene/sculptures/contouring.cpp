#include "experiment/scene/sculptures/contouring.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "experiment/base/error.h"
#include "experiment/base/parallel.h"
#include "experiment/scene/sculptures/stretched_grid.h"
#include "experiment/scene/sculptures/surface_nets.h"

namespace overt {

namespace {

/// Calls work(i) for each i below count, some thousands at a time on a thread.
template <class Work> void for_each_in_turns(std::size_t count, int threads, const Work& work) {
    constexpr std::size_t per_turn = 2048;
    const auto turn = [&](int t) {
        const std::size_t first = static_cast<std::size_t>(t) * per_turn;
        for (std::size_t i = first; i < std::min(count, first + per_turn); ++i)
            work(i);
    };
    parallel_for(static_cast<int>((count + per_turn - 1) / per_turn), turn, threads);
}

/// Rounds of drawing vertices towards their neighbours, and how far each goes.
constexpr int relaxing_rounds = 4;
constexpr double relaxing_share = 0.6;

/// Distance and gradient from the corners of a small tetrahedron [Quilez 2015].
struct Slope {
    double distance;
    glm::dvec3 gradient;
};

Slope slope_at(const ContourRequest& request, const glm::dvec3& point) {
    const double step = 0.02 * request.cell_mm;
    constexpr std::array<std::array<double, 3>, 4> corners{
        {{1, -1, -1}, {-1, -1, 1}, {-1, 1, -1}, {1, 1, 1}}};
    Slope slope{0.0, glm::dvec3(0.0)};
    for (const auto& [x, y, z] : corners) {
        const double distance = request.distance(point + step * glm::dvec3(x, y, z));
        slope.distance += 0.25 * distance;
        slope.gradient += glm::dvec3(x, y, z) * (distance / (4.0 * step));
    }
    return slope;
}

/// Brings the vertices of a net onto the surface and evens them out. Every vertex is worked out from the
/// last round's positions alone, so threads do not matter.
class Settling {
  public:
    Settling(const ContourRequest& request, PolygonNet& net)
        : request_(request), net_(net), gradients_(net.positions.size()) {
        collect_neighbours();
    }

    void run() {
        for_each_vertex([&](std::size_t i) { net_.positions[i] = step_with_new_slope(i); });
        for (int round = 0; round < relaxing_rounds; ++round) {
            std::vector<glm::dvec3> next(net_.positions.size());
            for_each_vertex([&](std::size_t i) { next[i] = relaxed(i); });
            net_.positions = std::move(next);
            if (round % 2 == 1)
                for_each_vertex([&](std::size_t i) { net_.positions[i] = step_with_new_slope(i); });
            else
                for_each_vertex([&](std::size_t i) { net_.positions[i] = step_with_old_slope(i); });
        }
        for_each_vertex([&](std::size_t i) { net_.positions[i] = step_with_old_slope(i); });
        for_each_vertex([&](std::size_t i) { net_.positions[i] = step_with_old_slope(i); });
    }

  private:
    void collect_neighbours() {
        std::vector<std::uint64_t> pairs;
        const auto connect = [&](std::uint32_t a, std::uint32_t b) {
            pairs.push_back(std::uint64_t{a} << 32 | b);
            pairs.push_back(std::uint64_t{b} << 32 | a);
        };
        for (const auto& quad : net_.quads)
            for (std::size_t k = 0; k < 4; ++k)
                connect(quad[k], quad[(k + 1) % 4]);
        for (const auto& triangle : net_.triangles)
            for (int k = 0; k < 3; ++k)
                connect(triangle[k], triangle[(k + 1) % 3]);
        std::sort(pairs.begin(), pairs.end());
        pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
        first_neighbour_.assign(net_.positions.size() + 1, 0);
        for (const std::uint64_t pair : pairs) {
            neighbours_.push_back(static_cast<std::uint32_t>(pair));
            first_neighbour_[(pair >> 32) + 1] = neighbours_.size();
        }
        for (std::size_t i = 1; i < first_neighbour_.size(); ++i)
            first_neighbour_[i] = std::max(first_neighbour_[i], first_neighbour_[i - 1]);
    }

    template <class Work> void for_each_vertex(const Work& work) const {
        for_each_in_turns(net_.positions.size(), request_.threads, work);
    }

    /// A Newton step, never longer than half a cell: where the slope is slight it says little.
    glm::dvec3 newton_step(std::size_t i, double distance) const {
        const glm::dvec3 gradient = gradients_[i];
        const glm::dvec3 step = gradient * (distance / std::max(0.05, glm::dot(gradient, gradient)));
        const double length = glm::length(step);
        const double longest = 0.5 * request_.cell_mm;
        return net_.positions[i] - step * (length > longest ? longest / length : 1.0);
    }

    glm::dvec3 step_with_new_slope(std::size_t i) {
        const Slope slope = slope_at(request_, net_.positions[i]);
        gradients_[i] = slope.gradient;
        return newton_step(i, slope.distance);
    }

    glm::dvec3 step_with_old_slope(std::size_t i) const {
        return newton_step(i, request_.distance(net_.positions[i]));
    }

    glm::dvec3 relaxed(std::size_t i) const {
        glm::dvec3 sum(0.0);
        for (std::size_t k = first_neighbour_[i]; k < first_neighbour_[i + 1]; ++k)
            sum += net_.positions[neighbours_[k]];
        const auto count = static_cast<double>(first_neighbour_[i + 1] - first_neighbour_[i]);
        const glm::dvec3 position = net_.positions[i];
        const glm::dvec3 wish = relaxing_share * (sum / count - position);
        const glm::dvec3 gradient = gradients_[i];
        return position + wish -
               gradient * (glm::dot(wish, gradient) / std::max(0.05, glm::dot(gradient, gradient)));
    }

    const ContourRequest& request_;
    PolygonNet& net_;
    std::vector<glm::dvec3> gradients_;
    std::vector<std::uint32_t> neighbours_;
    std::vector<std::size_t> first_neighbour_;
};

/// Least height of the two triangles of a quadrilateral, relative to their longest sides.
double worst_shape(const PolygonNet& net, const std::array<glm::uvec3, 2>& pair) {
    double worst = 1e30;
    for (const glm::uvec3& t : pair) {
        const glm::dvec3 a = net.positions[t.x];
        const glm::dvec3 b = net.positions[t.y];
        const glm::dvec3 c = net.positions[t.z];
        const double longest = std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)});
        worst = std::min(worst, glm::length(glm::cross(b - a, c - a)) / (longest * longest));
    }
    return worst;
}

/// Triangles flatter than this are avoided, however well they lie on the surface.
constexpr double flat_shape = 0.25;

/// Cuts a quadrilateral along the diagonal that lies nearer to the surface: along a fold and not across it,
/// so that the normals run smoothly in a mirror.
std::array<glm::uvec3, 2> cut_quad(const ContourRequest& request, const PolygonNet& net,
                                   const std::array<std::uint32_t, 4>& quad) {
    const auto [a, b, c, d] = quad;
    const std::array<glm::uvec3, 2> over_ac{{{a, b, c}, {a, c, d}}};
    const std::array<glm::uvec3, 2> over_bd{{{a, b, d}, {b, c, d}}};
    const double shape_ac = worst_shape(net, over_ac);
    const double shape_bd = worst_shape(net, over_bd);
    if (std::min(shape_ac, shape_bd) < flat_shape)
        return shape_ac >= shape_bd ? over_ac : over_bd;
    const auto off_surface = [&](std::uint32_t from, std::uint32_t to) {
        return std::abs(request.distance(0.5 * (net.positions[from] + net.positions[to])));
    };
    return off_surface(a, c) <= off_surface(b, d) ? over_ac : over_bd;
}

std::vector<glm::uvec3> triangles_of(const ContourRequest& request, const PolygonNet& net) {
    std::vector<glm::uvec3> triangles(net.quads.size() * 2);
    for_each_in_turns(net.quads.size(), request.threads, [&](std::size_t i) {
        const auto pair = cut_quad(request, net, net.quads[i]);
        triangles[2 * i] = pair[0];
        triangles[2 * i + 1] = pair[1];
    });
    triangles.insert(triangles.end(), net.triangles.begin(), net.triangles.end());
    return triangles;
}

/// Keeps the piece with the most triangles, and its vertices in their order.
ClosedSurface largest_piece(const std::vector<glm::dvec3>& positions,
                            const std::vector<glm::uvec3>& triangles) {
    std::vector<std::uint32_t> parent(positions.size());
    std::iota(parent.begin(), parent.end(), 0u);
    const auto root = [&](std::uint32_t v) {
        while (parent[v] != v)
            v = parent[v] = parent[parent[v]];
        return v;
    };
    for (const glm::uvec3& t : triangles)
        for (const std::uint32_t other : {t.y, t.z})
            parent[root(other)] = root(t.x);
    std::vector<std::size_t> size(positions.size(), 0);
    for (const glm::uvec3& t : triangles)
        ++size[root(t.x)];
    const auto largest =
        static_cast<std::uint32_t>(std::max_element(size.begin(), size.end()) - size.begin());
    ClosedSurface surface;
    std::vector<std::uint32_t> number(positions.size());
    for (std::uint32_t v = 0; v < positions.size(); ++v)
        if (root(v) == largest) {
            number[v] = static_cast<std::uint32_t>(surface.positions.size());
            surface.positions.push_back(positions[v]);
        }
    for (const glm::uvec3& t : triangles)
        if (root(t.x) == largest)
            surface.triangles.emplace_back(number[t.x], number[t.y], number[t.z]);
    return surface;
}

} // namespace

ClosedSurface contour(const ContourRequest& request) {
    PolygonNet net = surface_net(StretchedGrid(request));
    if (net.quads.empty())
        throw InputError("The grid meets nothing of the surface; contour it with smaller cells.");
    Settling(request, net).run();
    return largest_piece(net.positions, triangles_of(request, net));
}

} // namespace overt
