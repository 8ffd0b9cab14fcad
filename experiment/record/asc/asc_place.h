/// A place on the screen as two words of a line.
#pragma once

#include <cmath>
#include <optional>
#include <string_view>

#include "experiment/gaze.h"
#include "experiment/record/asc/asc_words.h"

namespace overt {

/// Beyond this a coordinate is the tracker's sign for "missing" (-32768, 1e8) or nonsense.
inline constexpr double largest_coordinate_px = 32000.0;

/// A place, nothing where it is missing, or an error.
struct AscPoint {
    bool is_valid = false;
    std::optional<ScreenPoint> point;
};

/// Of the words of its two coordinates; missing are also those beyond the largest.
inline AscPoint place_of(std::string_view x, std::string_view y) {
    if (is_missing(x) || is_missing(y))
        return {(is_missing(x) || number_of(x)) && (is_missing(y) || number_of(y)), std::nullopt};
    const std::optional<double> x_px = number_of(x), y_px = number_of(y);
    if (!x_px || !y_px)
        return {};
    if (std::abs(*x_px) > largest_coordinate_px || std::abs(*y_px) > largest_coordinate_px)
        return {true, std::nullopt};
    return {true, ScreenPoint{*x_px, *y_px}};
}

} // namespace overt
