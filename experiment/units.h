/// Quantities with their units in the type: one number each, converted only where a function says so.
#pragma once

#include <numbers>

namespace overt {

struct Degrees {
    double value = 0.0;
    friend constexpr auto operator<=>(const Degrees&, const Degrees&) = default;
};

struct Radians {
    double value = 0.0;
    friend constexpr auto operator<=>(const Radians&, const Radians&) = default;
};

struct Millimetres {
    double value = 0.0;
    friend constexpr auto operator<=>(const Millimetres&, const Millimetres&) = default;
};

constexpr Radians to_radians(Degrees angle) { return {angle.value * std::numbers::pi / 180.0}; }
constexpr Degrees to_degrees(Radians angle) { return {angle.value * 180.0 / std::numbers::pi}; }

/// A place on the screen in pixels: origin at the top left corner of the top left pixel, x to the right, y
/// down, so that pixel (0, 0) has its centre at (0.5, 0.5). Continuous, and free to lie outside the screen.
struct ScreenPoint {
    double x_px = 0.0;
    double y_px = 0.0;
    friend constexpr bool operator==(const ScreenPoint&, const ScreenPoint&) = default;
};

} // namespace overt
