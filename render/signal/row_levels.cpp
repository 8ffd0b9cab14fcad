#include "render/signal/row_levels.h"

#include <cstring>

#include "render/image/processor_clones.h"

namespace overt {

namespace {

// Four numbers that are reckoned with together; a compiler has them in registers of whatever width there is.
// Clones for processors that have wider registers give the same numbers: there is nothing in them that they
// may round differently.
using Four = double __attribute__((vector_size(32)));
using FourFloats = float __attribute__((vector_size(16)));

/// Red, green and blue of a pixel over the background; the fourth number means nothing.
inline __attribute__((always_inline)) void take_pixel(const glm::vec4& pixel, double background,
                                                      Four& light) {
    FourFloats stored;
    std::memcpy(&stored, &pixel, sizeof stored);
    light = __builtin_convertvector(stored, Four) + (1.0 - double{stored[3]}) * background;
}

/// From four colours to four numbers of each channel, stored from `place` on.
inline __attribute__((always_inline)) void put_four(ColourRun& run, int place, const Four& a, const Four& b,
                                                    const Four& c, const Four& d) {
    const Four ab_even = __builtin_shufflevector(a, b, 0, 4, 2, 6),
               ab_odd = __builtin_shufflevector(a, b, 1, 5, 3, 7);
    const Four cd_even = __builtin_shufflevector(c, d, 0, 4, 2, 6),
               cd_odd = __builtin_shufflevector(c, d, 1, 5, 3, 7);
    const Four red = __builtin_shufflevector(ab_even, cd_even, 0, 1, 4, 5),
               green = __builtin_shufflevector(ab_odd, cd_odd, 0, 1, 4, 5),
               blue = __builtin_shufflevector(ab_even, cd_even, 2, 3, 6, 7);
    std::memcpy(run.light[0].data() + place, &red, sizeof red);
    std::memcpy(run.light[1].data() + place, &green, sizeof green);
    std::memcpy(run.light[2].data() + place, &blue, sizeof blue);
}

OVERT_PROCESSOR_CLONES("avx2")
void light_of_pixels(const glm::vec4* pixels, int count, double background, ColourRun& run) {
    int i = 0;
    for (; i + 4 <= count; i += 4) {
        Four a, b, c, d;
        take_pixel(pixels[i], background, a);
        take_pixel(pixels[i + 1], background, b);
        take_pixel(pixels[i + 2], background, c);
        take_pixel(pixels[i + 3], background, d);
        put_four(run, i, a, b, c, d);
    }
    for (; i < count; ++i) {
        Four one;
        take_pixel(pixels[i], background, one);
        run.put(i, {one[0], one[1], one[2]});
    }
}

/// Of pairs joined by a box filter.
OVERT_PROCESSOR_CLONES("avx2")
void mean_light_of_pairs(const glm::vec4* pixels, int pairs, double background, ColourRun& run) {
    const auto mean_of = [&](int pair, Four& mean) __attribute__((always_inline)) {
        Four left, right;
        take_pixel(pixels[2 * pair], background, left);
        take_pixel(pixels[2 * pair + 1], background, right);
        mean = 0.5 * (left + right);
    };
    int i = 0;
    for (; i + 4 <= pairs; i += 4) {
        Four a, b, c, d;
        mean_of(i, a);
        mean_of(i + 1, b);
        mean_of(i + 2, c);
        mean_of(i + 3, d);
        put_four(run, i, a, b, c, d);
    }
    for (; i < pairs; ++i) {
        Four one;
        mean_of(i, one);
        run.put(i, {one[0], one[1], one[2]});
    }
}

} // namespace

void RowLevels::take_colours(int begin, int count, ColourRun& run) const {
    if (pixels_) {
        light_of_pixels(pixels_ + begin, count, background_, run);
        return;
    }
    for (int i = 0; i < count; ++i)
        run.put(i, light_[begin + i]);
}

void RowLevels::take_pairs(int begin, int count, ColourRun& run) const {
    if (pixels_) {
        mean_light_of_pairs(pixels_ + 2 * begin, count, background_, run);
        return;
    }
    for (int i = 0; i < count; ++i)
        run.put(i, light_of_pair(light_ + 2 * (begin + i)));
}

void RowLevels::take_greys(int begin, int count, ColourRun& run) const {
    take_colours(begin, count, run);
    const glm::dvec3& luminance = tables_->luminance;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
        run.light[0][i] =
            luminance.r * run.light[0][i] + luminance.g * run.light[1][i] + luminance.b * run.light[2][i];
}

glm::dvec3 RowLevels::light_of_pair(const glm::dvec3* left) const {
    if (!tables_->pair_filter)
        return 0.5 * (left[0] + left[1]);
    glm::dvec3 sum(0.0);
    for (int i = 0; i < 12; ++i)
        sum += (*tables_->pair_filter)[static_cast<std::size_t>(i)] * left[i - 5];
    return sum;
}

} // namespace overt
