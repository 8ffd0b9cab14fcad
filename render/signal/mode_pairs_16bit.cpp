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

// Four numbers that are reckoned with together; a compiler has them in registers of whatever width there is.
using Four = double __attribute__((vector_size(32)));
using FourFloats = float __attribute__((vector_size(16)));

/// The light of pairs joined by a box filter, all channels of a pair at once. Clones for processors that have
/// wider registers give the same numbers: there is nothing in it that they may round differently.
OVERT_PROCESSOR_CLONES("avx2")
void mean_light(const glm::vec4* pixels, int pairs, double background, ColourRun& run) {
    for (int pair = 0; pair < pairs; ++pair, pixels += 2) {
        FourFloats left, right;
        std::memcpy(&left, &pixels[0], sizeof left);
        std::memcpy(&right, &pixels[1], sizeof right);
        const Four behind_left = Four{} + (1.0 - double{left[3]}) * background,
                   behind_right = Four{} + (1.0 - double{right[3]}) * background;
        const Four mean = 0.5 * ((__builtin_convertvector(left, Four) + behind_left) +
                                 (__builtin_convertvector(right, Four) + behind_right));
        run.put(pair, {mean[0], mean[1], mean[2]});
    }
}

/// What encode() makes of whole pairs joined by a box filter: half of the time to load a stimulus went into
/// this.
void encode_box_pairs(const glm::vec4* pixels, int pairs, double background, const LevelTables& tables,
                      std::byte* into) {
    ColourRun run;
    for_runs(pairs, [&](int begin, int count) {
        mean_light(pixels + 2 * begin, count, background, run);
        run.find_levels(tables, count);
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
    static constexpr ModeCoding coding{encode, decode, predict, encode_box_pairs};
    return coding;
}

template <> const ModeCoding& mode_coding<OutputMode::vpixx_c48>() {
    static constexpr ModeCoding coding{encode, decode, predict, encode_box_pairs};
    return coding;
}

} // namespace overt
