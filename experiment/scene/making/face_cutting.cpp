#include "experiment/scene/making/face_cutting.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "experiment/scene/making/orientation.h"

namespace overt {
namespace {

using Corners = std::vector<std::uint32_t>;

/// The face seen along the axis that it faces most, from the side on which it goes round counter-clockwise.
void flatten(std::span<const std::uint32_t> corners, const RawMesh& mesh, std::vector<glm::dvec2>& points) {
    // Newell's normal, about the first corner: its rounding then is that of the face's size.
    const glm::dvec3 middle = mesh.positions[corners[0]];
    glm::dvec3 normal(0.0);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        normal += glm::cross(mesh.positions[corners[i]] - middle,
                             mesh.positions[corners[(i + 1) % corners.size()]] - middle);
    }
    const glm::dvec3 size = glm::abs(normal);
    const int along = size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2;
    int right = (along + 1) % 3, up = (along + 2) % 3;
    if (normal[along] < 0.0)
        std::swap(right, up);
    points.clear();
    for (const std::uint32_t corner : corners)
        points.emplace_back(mesh.positions[corner][right], mesh.positions[corner][up]);
}

/// Whether the outline turns to the left or goes straight at each corner, and the fan about the first corner
/// has no triangle without area but where two corners are at one place.
bool is_convex_fan(std::span<const glm::dvec2> points) {
    const std::size_t count = points.size();
    for (std::size_t i = 0; i < count; ++i) {
        if (orientation(points[i], points[(i + 1) % count], points[(i + 2) % count]) < 0)
            return false;
    }
    for (std::size_t i = 2; i < count; ++i) {
        const glm::dvec2 a = points[0], b = points[i - 1], c = points[i];
        if (orientation(a, b, c) <= 0 && a != b && b != c && c != a)
            return false;
    }
    return true;
}

/// Clips ears of one outline, which goes round counter-clockwise.
class EarClipping {
  public:
    explicit EarClipping(std::span<const glm::dvec2> points)
        : points_(points), next_(points.size()), previous_(points.size()), left_(points.size()) {
        for (std::size_t i = 0; i < left_; ++i) {
            next_[i] = (i + 1) % left_;
            previous_[i] = (i + left_ - 1) % left_;
        }
        for (std::size_t i = 0; i < left_; ++i) {
            if (turn_at(i) <= 0)
                hollow_.push_back(i);
        }
    }

    /// The triangles by numbers of points, as many as points less two; none if the outline crosses itself.
    std::vector<glm::uvec3> cut() {
        // An outline that never turns right and is not convex goes round more than once.
        if (hollow_.empty())
            return {};
        std::size_t at = 0;
        while (left_ > 3) {
            const auto ear = next_ear(at);
            if (!ear)
                return {};
            take(*ear);
            // Not the next corner: ears beside one another are slivers.
            at = next_[next_[*ear]];
        }
        if (turn_at(at) < 0)
            return {};
        take(at);
        return std::move(triangles_);
    }

  private:
    int turn_at(std::size_t i) const {
        return orientation(points_[previous_[i]], points_[i], points_[next_[i]]);
    }

    bool is_doubled(std::size_t i) const {
        return points_[i] == points_[previous_[i]] || points_[i] == points_[next_[i]];
    }

    /// The next ear from `at`; one that has no area only where there is no other.
    std::optional<std::size_t> next_ear(std::size_t at) const {
        std::optional<std::size_t> flat;
        for (std::size_t tried = 0; tried < left_; ++tried, at = next_[at]) {
            if (is_doubled(at))
                return at;
            const int turn = turn_at(at);
            if (turn > 0 && is_ear(at))
                return at;
            if (turn == 0 && !flat)
                flat = at;
        }
        return flat;
    }

    /// Whether no other corner lies in the triangle or on its edges. Where the outline does not cross itself,
    /// a corner in the triangle means that there is one at which the outline does not turn left.
    bool is_ear(std::size_t i) const {
        const glm::dvec2 a = points_[previous_[i]], b = points_[i], c = points_[next_[i]];
        const glm::dvec2 low = glm::min(glm::min(a, b), c), high = glm::max(glm::max(a, b), c);
        return std::ranges::none_of(hollow_, [&](std::size_t other) {
            const glm::dvec2 p = points_[other];
            if (p.x < low.x || p.x > high.x || p.y < low.y || p.y > high.y || other == i)
                return false;
            if (p == b) {
                // The outline comes by once more: not between the ear's edges.
                return is_between(a, b, c, points_[previous_[other]]) ||
                       is_between(a, b, c, points_[next_[other]]);
            }
            return p != a && p != c && orientation(a, b, p) >= 0 && orientation(b, c, p) >= 0 &&
                   orientation(c, a, p) >= 0;
        });
    }

    static bool is_between(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c, glm::dvec2 p) {
        return orientation(a, b, p) > 0 && orientation(b, c, p) > 0;
    }

    void take(std::size_t i) {
        const std::size_t before = previous_[i], after = next_[i];
        triangles_.emplace_back(before, i, after);
        next_[before] = after;
        previous_[after] = before;
        --left_;
        std::erase_if(hollow_, [&](std::size_t other) {
            return other == i || ((other == before || other == after) && turn_at(other) > 0);
        });
    }

    std::span<const glm::dvec2> points_;
    std::vector<std::size_t> next_, previous_;
    std::size_t left_;
    std::vector<std::size_t> hollow_; ///< corners at which the outline does not turn left
    std::vector<glm::uvec3> triangles_;
};

/// The same corners, beginning at the one with the lowest number; of several such with those that follow it.
Corners lowest_first(const Corners& corners) {
    const std::uint32_t lowest = *std::ranges::min_element(corners);
    Corners best;
    for (std::size_t begin = 0; begin < corners.size(); ++begin) {
        if (corners[begin] != lowest)
            continue;
        Corners turned = corners;
        std::rotate(turned.begin(), turned.begin() + static_cast<std::ptrdiff_t>(begin), turned.end());
        if (best.empty() || turned < best)
            best = std::move(turned);
    }
    return best;
}

} // namespace

void FaceFans::add_corner(std::uint32_t vertex) {
    if (corners_ == 0)
        first_ = vertex;
    if (corners_ == 3)
        fans_.push_back({static_cast<std::uint32_t>(mesh_->triangles.size() - 1), 3});
    if (corners_ >= 2)
        mesh_->triangles.emplace_back(first_, previous_, vertex);
    if (corners_ >= 3)
        ++fans_.back().corners;
    previous_ = vertex;
    ++corners_;
}

void FaceFans::cut() {
    Corners corners;
    std::vector<glm::dvec2> points;
    for (const Fan& fan : fans_) {
        const std::span triangles = std::span(mesh_->triangles).subspan(fan.first_triangle, fan.corners - 2);
        corners.assign({triangles[0].x, triangles[0].y});
        for (const glm::uvec3& triangle : triangles)
            corners.push_back(triangle.z);
        flatten(corners, *mesh_, points);
        if (is_convex_fan(points))
            continue;
        corners = lowest_first(corners);
        flatten(corners, *mesh_, points);
        const std::vector<glm::uvec3> cut = EarClipping(points).cut();
        mesh_->crossing_faces += cut.empty() ? 1 : 0;
        for (std::size_t i = 0; i < cut.size(); ++i)
            triangles[i] = {corners[cut[i].x], corners[cut[i].y], corners[cut[i].z]};
    }
    fans_.clear();
}

} // namespace overt
