/// mono++ and vpixx-m16: the luminance of each pixel in 16 bits.
#include "render/signal/mode_coding.h"
#include "render/signal/received_messages.h"
#include "render/signal/signal_decoder.h"
#include "render/signal/signal_prediction.h"

namespace overt {

namespace {

void encode(const RowLevels& row, int width, std::byte* into) {
    // Blue 0: no overlay.
    row.for_greys(width, [&](int begin, int count, const ColourRun& run) {
        const auto& code = run.levels[0];
        put_pixels(into + 4 * begin, count,
                   [&](std::size_t i) { return opaque_pixel(code[i] >> 8, code[i] & 255, 0); });
    });
}

ReceivedLight decode(const ScreenReader& reader) {
    bool is_message = false;
    ReceivedLight light = read_light({reader.width(), reader.height()}, 65535, [&](int x, int y) {
        if (x == 0)
            is_message = holds_message(reader, y);
        const Rgb pixel = reader.opaque_colour(x, y);
        if (pixel.b != 0 && !is_message)
            throw GraphicsError(fmt::format("pixel ({}, {}) shows overlay colour {}", x, y, pixel.b));
        const int grey = pixel.r * 256 + pixel.g;
        return Rgb{grey, grey, grey};
    });
    light.is_grey = true;
    return light;
}

std::array<double, 3> predict(const SignalPrediction& prediction, int x, int y) {
    const double grey = prediction.luminance_at(x, y);
    return {grey, grey, grey};
}

} // namespace

template <> const ModeCoding& mode_coding<OutputMode::mono_plus_plus>() {
    static constexpr ModeCoding coding{encode, decode, predict};
    return coding;
}

template <> const ModeCoding& mode_coding<OutputMode::vpixx_m16>() {
    static constexpr ModeCoding coding{encode, decode, predict};
    return coding;
}

} // namespace overt
