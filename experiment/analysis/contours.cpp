#include "experiment/analysis/contours.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "experiment/analysis/mesh_edges.h"

namespace overt {

namespace {

/// Rounding of projected coordinates is far below; a contour that comes so near to a pixel touches it.
constexpr double touching_px = 1e-6;
/// Twice the area of a projected triangle below which its side counts as doubtful, so that its edges are
/// taken for contours.
constexpr double doubtful_area_px2 = 1e-9;

/// Twice the signed area of the projected triangle (a, b, c).
double area_of(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Flags the pixels that a line touches.
class LineMarker {
  public:
    LineMarker(glm::ivec2 size_px, PixelFlags& flags) : size_px_(size_px), flags_(&flags) {}

    void mark(glm::dvec2 a, glm::dvec2 b) {
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
            mark_row(y, row(from - touching_px), row(to + touching_px));
        }
    }

  private:
    static int row(double at) { return static_cast<int>(std::floor(std::clamp(at, -1e6, 1e6))); }

    void mark_row(int y, int from, int to) {
        from = std::max(from, 0);
        to = std::min(to, size_px_.x - 1);
        if (from <= to)
            std::fill_n(flags_->begin() + static_cast<std::ptrdiff_t>(y) * size_px_.x + from, to - from + 1,
                        std::uint8_t{1});
    }

    glm::ivec2 size_px_;
    PixelFlags* flags_;
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

PixelFlags Contours::touched_pixels(const SightLines& lines, glm::ivec2 size_px) const {
    PixelFlags flags(static_cast<std::size_t>(size_px.x) * static_cast<std::size_t>(size_px.y), 0);
    std::vector<glm::dvec2> points(mesh_->positions.size());
    double nearest = std::numeric_limits<double>::infinity(), farthest = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const glm::dvec3 projected = lines.project(glm::dvec3(mesh_->positions[i]));
        points[i] = glm::dvec2(projected);
        nearest = std::min(nearest, projected.z);
        farthest = std::max(farthest, projected.z);
    }
    if (!(nearest > 1e-6 * farthest)) {
        std::fill(flags.begin(), flags.end(), std::uint8_t{1});
        return flags;
    }
    LineMarker marker(size_px, flags);
    for (const Edge& edge : folds_) {
        const glm::dvec2 from = points[edge.from], to = points[edge.to];
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
