/// How each output mode packs light into bytes, how a display reads them, and what it should light: three
/// accounts of one format that share nothing, so that each can be held against the others (signal_check.h).
/// What else there is to know of a mode is in its row of experiment/protocol/output_mode.h.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "experiment/protocol/output_mode.h"
#include "render/image/linear_image.h"
#include "render/signal/row_levels.h"

namespace overt {

class ScreenReader;
class SignalPrediction;
struct ReceivedLight;

struct ModeCoding {
    /// Packs a row of `width` pixels, a whole number of pairs where pixels are joined, into four bytes each:
    /// red, green, blue, and 255. From any thread.
    void (*encode)(const RowLevels& row, int width, std::byte* into);

    /// The light of a screen. Throws GraphicsError for what the mode does not allow.
    ReceivedLight (*decode)(const ScreenReader& reader);

    /// The linear light that pixel, or pair, (x, y) should have; not clipped.
    std::array<double, 3> (*predict)(const SignalPrediction& prediction, int x, int y);
};

/// The coding of a mode: defined once for each, in mode_….cpp. A mode without one does not link.
template <OutputMode mode> const ModeCoding& mode_coding();

const ModeCoding& coding_of(OutputMode mode);

/// For encoders: an opaque pixel as it lies in memory, red first.
inline std::uint32_t opaque_pixel(int red, int green, int blue) {
    static_assert(std::endian::native == std::endian::little);
    return static_cast<std::uint32_t>(red | green << 8 | blue << 16) | 0xff000000u;
}

/// Packs pixels into bytes: pixel_of(i) of 0 … count - 1.
template <class PixelOf> void put_pixels(std::byte* into, int count, const PixelOf& pixel_of) {
    for (int i = 0; i < count; ++i) {
        const std::uint32_t pixel = pixel_of(static_cast<std::size_t>(i));
        std::memcpy(into + 4 * i, &pixel, sizeof pixel);
    }
}

} // namespace overt
