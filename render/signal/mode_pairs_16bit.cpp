/// color++ and vpixx-c48: the colour of each pair of pixels in 16 bits per channel.
#include <cstring>

#include "render/image/processor_clones.h"
#include "render/signal/mode_coding.h"
#include "render/signal/signal_decoder.h"
#include "render/signal/signal_prediction.h"

namespace overt {

namespace {

/// The upper bytes of a pair's codes, and then the lower ones.
OVERT_PROCESSOR_CLONES("avx2")
void put_codes(const ColourRun& run, int pairs, std::byte* into) {
    const int *red = run.levels[0].data(), *green = run.levels[1].data(), *blue = run.levels[2].data();
    for (int i = 0; i < pairs; ++i) {
        const std::uint32_t upper = opaque_pixel(red[i] >> 8, green[i] >> 8, blue[i] >> 8);
        const std::uint32_t lower = opaque_pixel(red[i] & 255, green[i] & 255, blue[i] & 255);
        const std::uint64_t both = upper | std::uint64_t{lower} << 32;
        std::memcpy(into + 8 * i, &both, sizeof both);
    }
}

void encode(const RowLevels& row, int width, std::byte* into) {
    row.for_pairs(width / 2, [&](int begin, int count, const ColourRun& run) {
        put_codes(run, count, into + 8 * begin);
    });
}

ReceivedLight decode(const ScreenReader& reader) {
    return read_light({reader.width() / 2, reader.height()}, 65535, [&](int x, int y) {
        const Rgb upper = reader.opaque_colour(2 * x, y), lower = reader.opaque_colour(2 * x + 1, y);
        return Rgb{upper.r * 256 + lower.r, upper.g * 256 + lower.g, upper.b * 256 + lower.b};
    });
}

std::array<double, 3> predict(const SignalPrediction& prediction, int x, int y) {
    return prediction.pair_light_at(x, y);
}

} // namespace

template <> const ModeCoding& mode_coding<OutputMode::color_plus_plus>() {
    static constexpr ModeCoding coding{encode, decode, predict};
    return coding;
}

template <> const ModeCoding& mode_coding<OutputMode::vpixx_c48>() {
    static constexpr ModeCoding coding{encode, decode, predict};
    return coding;
}

} // namespace overt
