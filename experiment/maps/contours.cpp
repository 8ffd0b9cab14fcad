#include "experiment/maps/contours.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "experiment/maps/mesh_edges.h"

namespace overt {

namespace {

/// Rounding of projected coordinates is far below; a contour that comes so near to a pixel touches it.
constexpr double touching_px = 1e-6;
/// Twice the area of a projected triangle below which its side counts as doubtful, so that its edges are
/// taken for contours.
constexpr double doubtful_area_px2 = 1e-9;

/// Twice the signed area of the projected triangle (a, b, c).
double area_of(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Flags the pixels that an edge touches and does not pass behind.
class EdgeMarker {
  public:
    EdgeMarker(glm::ivec2 size_px, const std::vector<float>& farthest_visible, PixelFlags& flags)
        : size_px_(size_px), farthest_visible_(farthest_visible), flags_(flags) {}

    /// Image points (x, y) with their depths (z).
    void mark(glm::dvec3 a, glm::dvec3 b) {
        if (a.y > b.y)
            std::swap(a, b);
        const int top = row(a.y - touching_px), bottom = row(b.y + touching_px);
        for (int y = std::max(top, 0); y <= std::min(bottom, size_px_.y - 1); ++y) {
            // The piece of the line within this row's height.
            double from = a.x, to = b.x;
            if (b.y - a.y > touching_px) {
                const double slope = (b.x - a.x) / (b.y - a.y);
                from = a.x + slope * (std::max(a.y, y - touching_px) - a.y);
                to = a.x + slope * (std::min(b.y, y + 1 + touching_px) - a.y);
            }
            if (from > to)
                std::swap(from, to);
            mark_row(y, row(from - touching_px), row(to + touching_px), std::min(a.z, b.z));
        }
    }

  private:
    static int row(double at) { return static_cast<int>(std::floor(std::clamp(at, -1e6, 1e6))); }

    void mark_row(int y, int from, int to, double nearest_depth) {
        for (int x = std::max(from, 0); x <= std::min(to, size_px_.x - 1); ++x) {
            const std::size_t pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(size_px_.x) +
                                      static_cast<std::size_t>(x);
            if (nearest_depth <= static_cast<double>(farthest_visible_[pixel]))
                flags_[pixel] = 1;
        }
    }

    glm::ivec2 size_px_;
    const std::vector<float>& farthest_visible_;
    PixelFlags& flags_;
};

} // namespace

Contours::Contours(const Mesh& mesh) : mesh_(&mesh) {
    folds_.reserve(3 * mesh.triangles.size() / 2);
    for_each_edge(mesh, [&](std::uint32_t vertex, std::span<const TriangleSide> sides) {
        const auto opposite = [&](const TriangleSide& side) {
            return mesh.triangles[side.triangle][static_cast<int>(side.corner)];
        };
        if (sides.size() == 2) {
            folds_.push_back({vertex, sides[0].higher_vertex, opposite(sides[0]), opposite(sides[1])});
        } else {
            borders_.push_back({vertex, sides[0].higher_vertex, vertex, vertex});
        }
    });
}

PixelFlags Contours::touched_pixels(const SightLines& lines, glm::ivec2 size_px,
                                    const std::vector<float>& farthest_visible) const {
    PixelFlags flags(static_cast<std::size_t>(size_px.x) * static_cast<std::size_t>(size_px.y), 0);
    std::vector<glm::dvec3> points(mesh_->positions.size());
    double nearest = std::numeric_limits<double>::infinity(), farthest = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        points[i] = lines.project(glm::dvec3(mesh_->positions[i]));
        nearest = std::min(nearest, points[i].z);
        farthest = std::max(farthest, points[i].z);
    }
    if (!(nearest > 1e-6 * farthest)) {
        std::fill(flags.begin(), flags.end(), std::uint8_t{1});
        return flags;
    }
    EdgeMarker marker(size_px, farthest_visible, flags);
    for (const Edge& edge : folds_) {
        const glm::dvec3 &from = points[edge.from], &to = points[edge.to];
        const double left = area_of(from, to, points[edge.left]),
                     right = area_of(from, to, points[edge.right]);
        const bool goes_on = (left > doubtful_area_px2 && right < -doubtful_area_px2) ||
                             (left < -doubtful_area_px2 && right > doubtful_area_px2);
        if (!goes_on)
            marker.mark(from, to);
    }
    for (const Edge& edge : borders_)
        marker.mark(points[edge.from], points[edge.to]);
    return flags;
}

} // namespace overt
