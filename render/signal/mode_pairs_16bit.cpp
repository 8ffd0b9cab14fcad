/// color++ and vpixx-c48: the colour of each pair of pixels in 16 bits per channel.
#include <cstring>

#include "render/image/processor_clones.h"
#include "render/signal/mode_coding.h"
#include "render/signal/signal_decoder.h"
#include "render/signal/signal_prediction.h"

namespace overt {

namespace {

void encode(const RowLevels& row, int width, std::byte* into) {
    for (int x = 0; x < width; x += 2, into += 8) {
        const glm::ivec3 code = row.pair(x);
        put_bytes(into, code.r >> 8, code.g >> 8, code.b >> 8);
        put_bytes(into + 4, code.r & 255, code.g & 255, code.b & 255);
    }
}

// Four numbers that are reckoned with together; a compiler has them in registers of whatever width there is.
using Four = double __attribute__((vector_size(32)));
using FourFloats = float __attribute__((vector_size(16)));
using FourInts = int __attribute__((vector_size(16)));

/// What encode() makes of whole pairs joined by a box filter, with all channels of a pair at once: half of
/// the time to load a stimulus went into this. Clones for processors that have wider registers give the same
/// bytes: there is nothing in it that they may round differently.
template <class CodesOf>
inline __attribute__((always_inline)) void encode_means(const glm::vec4* pixels, int pairs, double background,
                                                        std::byte* into, const CodesOf& codes_of) {
    const Four zero{}, one = Four{} + 1.0;
    for (int pair = 0; pair < pairs; ++pair, pixels += 2, into += 8) {
        FourFloats left, right;
        std::memcpy(&left, &pixels[0], sizeof left);
        std::memcpy(&right, &pixels[1], sizeof right);
        const Four behind_left = Four{} + (1.0 - double{left[3]}) * background,
                   behind_right = Four{} + (1.0 - double{right[3]}) * background;
        const Four mean = 0.5 * ((__builtin_convertvector(left, Four) + behind_left) +
                                 (__builtin_convertvector(right, Four) + behind_right));
        const Four above = mean > zero ? mean : zero, inside = above < one ? above : one;
        const FourInts code = codes_of(inside);
        put_bytes(into, code[0] >> 8, code[1] >> 8, code[2] >> 8);
        put_bytes(into + 4, code[0] & 255, code[1] & 255, code[2] & 255);
    }
}

OVERT_PROCESSOR_CLONES("avx2")
void encode_linear_pairs(const glm::vec4* pixels, int pairs, double background, double levels,
                         std::byte* into) {
    const Four all_levels = Four{} + levels, all_halves = Four{} + LevelTable::half;
    encode_means(pixels, pairs, background, into, [&](const Four& inside) {
        return __builtin_convertvector(inside * all_levels + all_halves, FourInts);
    });
}

OVERT_PROCESSOR_CLONES("avx2")
void encode_curved_pairs(const glm::vec4* pixels, int pairs, double background, const LevelTables& tables,
                         std::byte* into) {
    const LevelTable &red = tables.at(0), &green = tables.at(1), &blue = tables.at(2);
    // Neighbours in the background are the same light.
    double last_red = -1.0, last_green = -1.0, last_blue = -1.0;
    FourInts code{};
    encode_means(pixels, pairs, background, into, [&](const Four& inside) {
        if (inside[0] != last_red || inside[1] != last_green || inside[2] != last_blue) {
            last_red = inside[0];
            last_green = inside[1];
            last_blue = inside[2];
            code = FourInts{red.level_inside(last_red), green.level_inside(last_green),
                            blue.level_inside(last_blue), 0};
        }
        return code;
    });
}

void encode_box_pairs(const glm::vec4* pixels, int pairs, double background, const LevelTables& tables,
                      std::byte* into) {
    // Either all curves are tabulated, or there is one that is linear.
    if (tables.at(0).is_linear())
        encode_linear_pairs(pixels, pairs, background, tables.at(0).levels(), into);
    else
        encode_curved_pairs(pixels, pairs, background, tables, into);
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
