/// Compares what was drawn with what the display box received, line by line and byte by byte.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "devices/display_box/bits_protocol.h"

namespace overt {

/// The left part of a video line as it stands in the framebuffer.
struct DrawnLine {
    int line = 1; ///< from the top, counted as the box counts: the vendor's scripts begin with 1
    std::vector<RgbBytes> pixels;
};

/// One byte that arrived changed.
struct ChangedByte {
    int line = 1;
    std::size_t pixel = 0;   ///< from the left, from 0
    std::size_t channel = 0; ///< 0 red, 1 green, 2 blue
    int sent = 0, received = 0;
};

/// What became of one line.
struct LineVerdict {
    int line = 1;
    int readings = 0;
    long changed = 0;            ///< bytes, over all readings
    bool is_unsteady = false;    ///< it came differently when read again
    std::optional<int> shift_px; ///< by which every reading was moved to the right, otherwise whole

    /// "as drawn", or what happened to it.
    std::string description() const;
};

/// What became of all the lines.
struct VideoLineReport {
    static constexpr std::size_t most_changes = 32;

    int readings = 0; ///< lines read back, each repetition counted
    long bytes = 0;   ///< bytes compared
    long changed = 0; ///< of these, how many arrived changed
    /// Lines that came differently when read again: something dithers over time, or the picture was not
    /// still.
    int unsteady_lines = 0;
    /// All lines arrived moved to the right by so many pixels (negative: left), otherwise whole.
    std::optional<int> shift_px;
    std::vector<LineVerdict> lines;
    std::vector<ChangedByte> changes; ///< the first of them, at most most_changes

    bool good() const { return readings > 0 && changed == 0 && unsteady_lines == 0; }

    /// Several lines of text: the verdict, the likely cause, the first changes.
    std::string description() const;
};

/// Adds a line with its readings, of which each has as many pixels as were drawn.
void compare_video_line(const DrawnLine& drawn, const std::vector<std::vector<RgbBytes>>& readings,
                        VideoLineReport& report);

} // namespace overt
