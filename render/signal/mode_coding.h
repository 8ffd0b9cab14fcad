/// How each output mode packs light into bytes, how a display reads them, and what it should light: three
/// accounts of one format that share nothing, so that each can be held against the others (signal_check.h).
/// What else there is to know of a mode is in its row of experiment/protocol/output_mode.h.
#pragma once

#include <array>
#include <cstddef>

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

    /// encode() of whole pairs joined by a box filter, from the picture itself: what takes the time when
    /// stimuli are loaded. Or null.
    void (*encode_box_pairs)(const glm::vec4* pixels, int pairs, double background, const LevelTables& tables,
                             std::byte* into) = nullptr;
};

/// The coding of a mode: defined once for each, in mode_….cpp. A mode without one does not link.
template <OutputMode mode> const ModeCoding& mode_coding();

const ModeCoding& coding_of(OutputMode mode);

/// For encoders: an opaque pixel.
inline void put_bytes(std::byte* pixel, int red, int green, int blue) {
    pixel[0] = static_cast<std::byte>(red);
    pixel[1] = static_cast<std::byte>(green);
    pixel[2] = static_cast<std::byte>(blue);
    pixel[3] = std::byte{255};
}

} // namespace overt
