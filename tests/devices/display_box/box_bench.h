/// A box on a line in memory, and pictures that it may have received.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "devices/display_box/display_plus_plus.h"
#include "experiment/base/error.h"
#include "tests/devices/link/in_memory_line.h"

namespace overt::test {

/// A box on a line, opened.
struct Bench {
    VirtualClock clock;
    InMemoryBitsBox box{clock};
    DisplayPlusPlusSettings settings;

    DisplayPlusPlus open() { return DisplayPlusPlus(box.line(), clock, settings); }
};

inline RgbBytes ramp(int line, int pixel) {
    return {static_cast<std::uint8_t>(pixel), static_cast<std::uint8_t>(255 - pixel),
            static_cast<std::uint8_t>(line + 3 * pixel)};
}

inline std::vector<DrawnLine> drawn_ramps(std::initializer_list<int> lines) {
    std::vector<DrawnLine> drawn;
    for (const int line : lines) {
        drawn.push_back({line, {}});
        for (int pixel = 0; pixel < 256; ++pixel)
            drawn.back().pixels.push_back(ramp(line, pixel));
    }
    return drawn;
}

inline std::string message_of(const std::function<void()>& action) {
    try {
        action();
    } catch (const DeviceError& error) {
        return error.what();
    }
    return "nothing was thrown";
}

} // namespace overt::test
