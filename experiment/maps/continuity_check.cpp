#include "experiment/maps/continuity_check.h"

#include <algorithm>
#include <vector>

namespace overt {

namespace {

bool share_a_corner(const WalkTriangle& one, const WalkTriangle& other) {
    return std::any_of(one.corners.begin(), one.corners.end(), [&](const glm::vec3& corner) {
        return std::find(other.corners.begin(), other.corners.end(), corner) != other.corners.end();
    });
}

/// Checks the pixels of one map.
class ContinuityCheck {
  public:
    ContinuityCheck(const TriangleMap& map, const SightLines& lines, const SurfaceWalk& walk)
        : map_(map), lines_(lines), walk_(walk) {}

    /// The sheet seen at one pixel's centre is that seen at the other's, or none is seen at either.
    bool goes_on(glm::ivec2 one, glm::ivec2 other) const {
        const std::uint32_t code = map_.code_at(one.x, one.y), next = map_.code_at(other.x, other.y);
        if (code == next)
            return true;
        if (code == 0 || next == 0)
            return false;
        const auto& neighbours = walk_.triangle(code - 1).neighbours;
        if (std::find(neighbours.begin(), neighbours.end(), next - 1) != neighbours.end())
            return true;
        Meeting meeting;
        const bool met =
            walk_.meet(code - 1, lines_.origin(), lines_.direction_through(glm::dvec2(other) + 0.5), meeting);
        // Corners are snapped to a fraction of a pixel when a map is drawn: a centre beside an edge may be
        // given to the next triangle.
        return met && (meeting.triangle + 1 == next ||
                       share_a_corner(walk_.triangle(meeting.triangle), walk_.triangle(next - 1)));
    }

  private:
    const TriangleMap& map_;
    const SightLines& lines_;
    const SurfaceWalk& walk_;
};

} // namespace

void flag_discontinuities(const TriangleMap& map, const SightLines& lines, const SurfaceWalk& walk,
                          PixelFlags& flags) {
    const ContinuityCheck check(map, lines, walk);
    const glm::ivec2 size = map.size_px;
    const auto is_flagged = [&](glm::ivec2 pixel) {
        return flags[static_cast<std::size_t>(pixel.y) * static_cast<std::size_t>(size.x) +
                     static_cast<std::size_t>(pixel.x)] != 0;
    };
    std::vector<glm::ivec2> broken;
    for (int y = 0; y < size.y; ++y) {
        for (int x = 0; x < size.x; ++x) {
            const glm::ivec2 here(x, y);
            if (is_flagged(here))
                continue;
            for (const glm::ivec2 other : {glm::ivec2(x + 1, y), glm::ivec2(x, y + 1)}) {
                if (other.x < size.x && other.y < size.y && !is_flagged(other) &&
                    !check.goes_on(here, other)) {
                    broken.push_back(here);
                    broken.push_back(other);
                }
            }
        }
    }
    for (const glm::ivec2 pixel : broken) {
        for (int y = std::max(pixel.y - 1, 0); y <= std::min(pixel.y + 1, size.y - 1); ++y) {
            for (int x = std::max(pixel.x - 1, 0); x <= std::min(pixel.x + 1, size.x - 1); ++x)
                flags[static_cast<std::size_t>(y) * static_cast<std::size_t>(size.x) +
                      static_cast<std::size_t>(x)] = 1;
        }
    }
}

} // namespace overt
