/// native-8bit and native-10bit: each level as it is.
#include "render/signal/mode_coding.h"
#include "render/signal/signal_decoder.h"
#include "render/signal/signal_prediction.h"

namespace overt {

namespace {

void encode(const RowLevels& row, int width, std::byte* into) {
    row.for_colours(width, [&](int begin, int count, const ColourRun& run) {
        const auto& levels = run.levels;
        put_pixels(into + 4 * begin, count,
                   [&](std::size_t i) { return opaque_pixel(levels[0][i], levels[1][i], levels[2][i]); });
    });
}

ReceivedLight decode_8bit(const ScreenReader& reader) {
    return read_light({reader.width(), reader.height()}, 255,
                      [&](int x, int y) { return reader.opaque_colour(x, y); });
}

ReceivedLight decode_10bit(const ScreenReader& reader) {
    return read_light({reader.width(), reader.height()}, 1023, [&](int x, int y) {
        const std::uint32_t word = reader.word(x, y);
        return Rgb{static_cast<int>(word & 1023u), static_cast<int>(word >> 10 & 1023u),
                   static_cast<int>(word >> 20 & 1023u)};
    });
}

std::array<double, 3> predict(const SignalPrediction& prediction, int x, int y) {
    return prediction.light_at(x, y);
}

} // namespace

template <> const ModeCoding& mode_coding<OutputMode::native_8bit>() {
    static constexpr ModeCoding coding{encode, decode_8bit, predict};
    return coding;
}

template <> const ModeCoding& mode_coding<OutputMode::native_10bit>() {
    static constexpr ModeCoding coding{encode, decode_10bit, predict};
    return coding;
}

} // namespace overt
