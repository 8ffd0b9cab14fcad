#include "experiment/surface/intrinsic_triangulation.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace overt {
namespace {

/// By how much two sides of a triangle must exceed the third, as a share of the mean edge.
constexpr double least_excess = 1e-5;

/// Sums of cotangents down to this are 0 but for rounding; exchanging there could go on for ever.
constexpr double rounding = 1e-10;

/// Place, in the plane, of the corner opposite the side from (0, 0) to (base, 0).
glm::dvec2 apex(double base, double from_start, double from_end) {
    const double x = (base * base + from_start * from_start - from_end * from_end) / (2.0 * base);
    return {x, std::sqrt(std::max(0.0, from_start * from_start - x * x))};
}

} // namespace

IntrinsicTriangulation::IntrinsicTriangulation(std::span<const glm::dvec3> positions_mm,
                                               std::span<const glm::uvec3> triangles) {
    triangles_.reserve(triangles.size());
    for (const glm::uvec3& corners : triangles) {
        Triangle& triangle = triangles_.emplace_back();
        for (int k = 0; k < 3; ++k) {
            const auto slot = static_cast<std::size_t>(k);
            triangle.nodes[slot] = corners[k];
            triangle.lengths_mm[slot] =
                glm::distance(positions_mm[corners[k]], positions_mm[corners[(k + 1) % 3]]);
        }
    }
    lengthen_edges();
    find_mates(positions_mm.size());
    exchange_edges();
    sort_corners(positions_mm.size());
}

void IntrinsicTriangulation::lengthen_edges() {
    double sum = 0.0;
    for (const Triangle& t : triangles_)
        sum += t.lengths_mm[0] + t.lengths_mm[1] + t.lengths_mm[2];
    const double wanted = triangles_.empty() ? 0.0 : least_excess * sum / (3.0 * double(triangles_.size()));
    double lacking = 0.0;
    for (const Triangle& t : triangles_) {
        for (std::size_t k = 0; k < 3; ++k) {
            const double excess = t.lengths_mm[k] + t.lengths_mm[(k + 1) % 3] - t.lengths_mm[(k + 2) % 3];
            lacking = std::max(lacking, wanted - excess);
        }
    }
    if (lacking > 0.0) {
        for (Triangle& t : triangles_) {
            for (double& length : t.lengths_mm)
                length += lacking;
        }
    }
}

void IntrinsicTriangulation::find_mates(std::size_t nodes) {
    struct Side {
        std::uint32_t higher, side;
    };
    const auto ends = [&](std::uint32_t side) {
        const Triangle& t = triangles_[side / 3];
        return std::pair(t.nodes[side % 3], t.nodes[(side % 3 + 1) % 3]);
    };
    const auto sides = static_cast<std::uint32_t>(3 * triangles_.size());
    mates_.assign(sides, none);
    // One bin for each lower end of an edge.
    std::vector<std::size_t> bin(nodes + 1, 0);
    for (std::uint32_t s = 0; s < sides; ++s)
        ++bin[std::min(ends(s).first, ends(s).second) + 1];
    std::partial_sum(bin.begin(), bin.end(), bin.begin());
    std::vector<Side> sorted(sides);
    std::vector<std::size_t> next(bin.begin(), bin.end());
    for (std::uint32_t s = 0; s < sides; ++s) {
        const auto [a, b] = ends(s);
        sorted[next[std::min(a, b)]++] = {std::max(a, b), s};
    }
    for (std::size_t node = 0; node < nodes; ++node) {
        const std::span at(sorted.data() + bin[node], bin[node + 1] - bin[node]);
        std::stable_sort(at.begin(), at.end(),
                         [](const Side& a, const Side& b) { return a.higher < b.higher; });
        for (std::size_t begin = 0; begin < at.size();) {
            std::size_t end = begin;
            while (end < at.size() && at[end].higher == at[begin].higher)
                ++end;
            if (end - begin == 2 && ends(at[begin].side).first != ends(at[begin + 1].side).first) {
                mates_[at[begin].side] = at[begin + 1].side;
                mates_[at[begin + 1].side] = at[begin].side;
            } else if (end - begin > 1) {
                for (std::size_t i = begin; i < end; ++i)
                    mates_[at[i].side] = fixed;
            }
            begin = end;
        }
    }
}

double IntrinsicTriangulation::cotangent_opposite(std::uint32_t side) const {
    const Triangle& t = triangles_[side / 3];
    const std::size_t k = side % 3;
    const double a = t.lengths_mm[k], b = t.lengths_mm[(k + 1) % 3], c = t.lengths_mm[(k + 2) % 3];
    // Heron's formula, with the factors as differences of sides.
    const double area =
        0.25 * std::sqrt(std::max(0.0, (a + b + c) * (b + c - a) * (c + a - b) * (a + b - c)));
    return area > 0.0 ? (b * b + c * c - a * a) / (4.0 * area) : 0.0;
}

void IntrinsicTriangulation::exchange_edges() {
    std::vector<std::uint32_t> open(mates_.size());
    std::iota(open.rbegin(), open.rend(), 0u);
    // Ends by itself (Bobenko and Springborn 2007); the limit is for what rounding may do.
    std::size_t left = 100 * mates_.size();
    while (!open.empty() && left-- > 0) {
        const std::uint32_t side = open.back();
        open.pop_back();
        const std::uint32_t mate = mates_[side];
        if (mate >= fixed || mate / 3 == side / 3)
            continue;
        if (cotangent_opposite(side) + cotangent_opposite(mate) >= -rounding)
            continue;
        exchange(side);
        ++exchanged_;
        for (const std::uint32_t triangle : {side / 3, mate / 3}) {
            for (std::uint32_t k = 0; k < 3; ++k)
                open.push_back(3 * triangle + k);
        }
    }
}

void IntrinsicTriangulation::exchange(std::uint32_t side) {
    // Before: (a, b, c) and (b, a, d). After: (c, a, d) and (d, b, c).
    const std::uint32_t mate = mates_[side];
    const std::uint32_t t0 = side / 3, t1 = mate / 3;
    const std::uint32_t s0 = side % 3, s1 = mate % 3;
    const Triangle first = triangles_[t0], second = triangles_[t1];
    const std::uint32_t a = first.nodes[s0], b = first.nodes[(s0 + 1) % 3], c = first.nodes[(s0 + 2) % 3];
    const std::uint32_t d = second.nodes[(s1 + 2) % 3];
    const double ab = first.lengths_mm[s0], bc = first.lengths_mm[(s0 + 1) % 3];
    const double ca = first.lengths_mm[(s0 + 2) % 3];
    const double ad = second.lengths_mm[(s1 + 1) % 3], db = second.lengths_mm[(s1 + 2) % 3];
    const glm::dvec2 above = apex(ab, ca, bc);
    glm::dvec2 below = apex(ab, ad, db);
    below.y = -below.y;
    const double cd = glm::distance(above, below);
    const std::uint32_t beyond_bc = mates_[3 * t0 + (s0 + 1) % 3], beyond_ca = mates_[3 * t0 + (s0 + 2) % 3];
    const std::uint32_t beyond_ad = mates_[3 * t1 + (s1 + 1) % 3], beyond_db = mates_[3 * t1 + (s1 + 2) % 3];

    triangles_[t0] = {{c, a, d}, {ca, ad, cd}};
    triangles_[t1] = {{d, b, c}, {db, bc, cd}};
    // A side whose mate was one of these two triangles moves with it.
    const std::array<std::uint32_t, 4> old{3 * t0 + (s0 + 1) % 3, 3 * t0 + (s0 + 2) % 3,
                                           3 * t1 + (s1 + 1) % 3, 3 * t1 + (s1 + 2) % 3};
    const std::array<std::uint32_t, 4> now{3 * t1 + 1, 3 * t0 + 0, 3 * t0 + 1, 3 * t1 + 0};
    std::array<std::uint32_t, 4> beyond{beyond_bc, beyond_ca, beyond_ad, beyond_db};
    for (std::uint32_t& other : beyond) {
        for (std::size_t i = 0; i < 4; ++i) {
            if (other == old[i]) {
                other = now[i];
                break;
            }
        }
    }
    for (std::size_t i = 0; i < 4; ++i) {
        mates_[now[i]] = beyond[i];
        if (beyond[i] < fixed)
            mates_[beyond[i]] = now[i];
    }
    mates_[3 * t0 + 2] = 3 * t1 + 2;
    mates_[3 * t1 + 2] = 3 * t0 + 2;
}

void IntrinsicTriangulation::sort_corners(std::size_t nodes) {
    corners_begin_.assign(nodes + 1, 0);
    for (const Triangle& t : triangles_) {
        for (const std::uint32_t node : t.nodes)
            ++corners_begin_[node + 1];
    }
    std::partial_sum(corners_begin_.begin(), corners_begin_.end(), corners_begin_.begin());
    corners_.resize(3 * triangles_.size());
    std::vector<std::size_t> next(corners_begin_.begin(), corners_begin_.end());
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
        for (std::uint32_t k = 0; k < 3; ++k)
            corners_[next[triangles_[t].nodes[k]]++] = {t, k};
    }
}

std::span<const IntrinsicTriangulation::Corner> IntrinsicTriangulation::corners_at(std::uint32_t node) const {
    return std::span(corners_).subspan(corners_begin_[node], corners_begin_[node + 1] - corners_begin_[node]);
}

std::vector<IntrinsicTriangulation::EdgeWeight> IntrinsicTriangulation::edge_weights() const {
    std::vector<EdgeWeight> weights;
    weights.reserve(mates_.size() / 2 + 1);
    const auto add = [&](std::uint32_t side, double twice) {
        const Triangle& t = triangles_[side / 3];
        const std::uint32_t a = t.nodes[side % 3], b = t.nodes[(side % 3 + 1) % 3];
        if (a != b && twice > 0.0)
            weights.push_back({a, b, 0.5 * twice});
    };
    for (std::uint32_t side = 0; side < mates_.size(); ++side) {
        const std::uint32_t mate = mates_[side];
        if (mate >= fixed)
            add(side, cotangent_opposite(side));
        else if (side < mate)
            add(side, cotangent_opposite(side) + cotangent_opposite(mate));
    }
    return weights;
}

} // namespace overt
