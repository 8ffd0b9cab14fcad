/// What is drawn over stimuli: lines of one light, with a rim in which they stand out from any ground.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "experiment/units.h"

namespace overt {

/// A line through points of the screen; of one point, a disc. It lies in no memory of its own: a presentation
/// must not allocate.
struct MarkLine {
    static constexpr std::size_t most_points = 65;
    std::array<ScreenPoint, most_points> points{};
    std::size_t count = 0; ///< of them; 0: nothing is drawn
    double width_px = 1.0;
    /// The same line, whatever lies behind its points.
    friend bool operator==(const MarkLine& a, const MarkLine& b) noexcept {
        return a.count == b.count && a.width_px == b.width_px &&
               std::equal(a.points.begin(), a.points.begin() + static_cast<std::ptrdiff_t>(a.count),
                          b.points.begin());
    }
};

/// Lines that are drawn together, the rims of all below them.
struct StimulusMark {
    static constexpr std::size_t most_lines = 2;
    std::array<MarkLine, most_lines> lines{};
    std::size_t count = 0;
    std::array<double, 3> light{1.0, 1.0, 1.0}; ///< linear, 0 ... 1 of the display's white, as frames have it
    double rim_px = 1.0;                        ///< of dark light around it; 0: none
    friend bool operator==(const StimulusMark& a, const StimulusMark& b) noexcept {
        return a.count == b.count && a.light == b.light && a.rim_px == b.rim_px &&
               std::equal(a.lines.begin(), a.lines.begin() + static_cast<std::ptrdiff_t>(a.count),
                          b.lines.begin());
    }
};

} // namespace overt
