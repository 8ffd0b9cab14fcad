/// Areas of the screen that gaze is asked for, where nothing is known of what was shown.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "experiment/units.h"

namespace overt {

/// A shape on the screen, all the time or for a while.
struct ScreenArea {
    enum class Shape : std::uint8_t { rectangle, ellipse, polygon };
    std::string name; ///< shapes of one name are one area together
    Shape shape = Shape::rectangle;
    /// Of a polygon its corners, three at least, in either order; of others the top left and the bottom right
    /// corner of the box that they fill.
    std::vector<ScreenPoint> points;
    // Since the onset of the presentation; without one, since the trial's first sample.
    double from_s = 0.0, until_s = std::numeric_limits<double>::infinity();

    /// Left and top edges are part of it, right and bottom ones are not, so that areas side by side share
    /// nothing; of an ellipse the edge is.
    bool contains(ScreenPoint point) const;
    bool is_there_at(double time_s) const { return time_s >= from_s && time_s < until_s; }
    bool operator==(const ScreenArea&) const = default;
};

/// How many of a screen's pixels have their middle in one of these shapes.
std::int64_t pixels_in(std::span<const ScreenArea* const> shapes, glm::ivec2 screen_px);

} // namespace overt
