/// A screen as a display receives it, pixel by pixel. For decoders only: what packs pixels has code of its
/// own.
#pragma once

#include <cstdint>
#include <span>

#include <fmt/format.h>
#include <glm/glm.hpp>

#include "experiment/base/error.h"

namespace overt {

/// A screen as it is scanned out: top row first, four bytes to a pixel, red first; in native_10bit
/// little-endian words with red in the lowest ten bits.
struct SignalScreen {
    glm::ivec2 size_px{0};
    std::span<const std::byte> bytes;
};

struct Rgb {
    int r = 0, g = 0, b = 0;
    bool operator==(const Rgb&) const = default;
};

/// Reads pixels of a screen, which must outlive it.
class ScreenReader {
  public:
    /// Throws GraphicsError if there are not as many bytes as the size says.
    explicit ScreenReader(const SignalScreen& screen) : screen_(screen) {
        const std::int64_t wanted = std::int64_t{4} * screen.size_px.x * screen.size_px.y;
        if (static_cast<std::int64_t>(screen.bytes.size()) != wanted) {
            throw GraphicsError(fmt::format("a screen of {} x {} pixels has {} bytes where {} are expected",
                                            screen.size_px.x, screen.size_px.y, screen.bytes.size(), wanted));
        }
    }

    int byte(int x, int y, int channel) const {
        const std::int64_t at = 4 * (std::int64_t{y} * screen_.size_px.x + x) + channel;
        return std::to_integer<int>(screen_.bytes[static_cast<std::size_t>(at)]);
    }
    Rgb colour(int x, int y) const { return {byte(x, y, 0), byte(x, y, 1), byte(x, y, 2)}; }
    /// Throws GraphicsError for a pixel that is not opaque.
    Rgb opaque_colour(int x, int y) const {
        if (byte(x, y, 3) != 255)
            throw GraphicsError(fmt::format("pixel ({}, {}) is not opaque: the desktop may mix it", x, y));
        return colour(x, y);
    }
    /// The pixel's four bytes as one number, the first lowest.
    std::uint32_t word(int x, int y) const {
        std::uint32_t value = 0;
        for (int i = 3; i >= 0; --i)
            value = value * 256 + static_cast<std::uint32_t>(byte(x, y, i));
        return value;
    }
    int width() const { return screen_.size_px.x; }
    int height() const { return screen_.size_px.y; }

  private:
    SignalScreen screen_;
};

} // namespace overt
