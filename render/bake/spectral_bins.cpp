#include "render/bake/spectral_bins.h"

#include <algorithm>
#include <bit>
#include <cstdint>

#include "render/image/processor_clones.h"

namespace overt {

namespace {

/// 2^x for -125 <= x <= 125: the exponent's bits, and a series of e^(f ln 2) for the rest of -1 < f < 1.
inline float power_of_two(float x) {
    const int whole = static_cast<int>(x);
    const float y = (x - static_cast<float>(whole)) * 0.693147181f;
    // Taylor's series to the 9th power: what is left out is below 1e-8.
    float series = 1.0f / 362880.0f;
    series = series * y + 1.0f / 40320.0f;
    series = series * y + 1.0f / 5040.0f;
    series = series * y + 1.0f / 720.0f;
    series = series * y + 1.0f / 120.0f;
    series = series * y + 1.0f / 24.0f;
    series = series * y + 1.0f / 6.0f;
    series = series * y + 0.5f;
    series = series * y + 1.0f;
    series = series * y + 1.0f;
    return series * std::bit_cast<float>((whole + 127) << 23);
}

} // namespace

float Bins::largest() const {
    // Side by side, and the last eight over the ones before: the 32nd is no bin.
    constexpr std::size_t lanes = 8;
    std::array<float, lanes> most;
    for (std::size_t lane = 0; lane < lanes; ++lane)
        most[lane] = value[lane];
    for (const std::size_t from : {std::size_t{8}, std::size_t{16}, spectral_bins - lanes})
        for (std::size_t lane = 0; lane < lanes; ++lane)
            most[lane] = std::max(most[lane], value[from + lane]);
    return *std::max_element(most.begin(), most.end());
}

OVERT_PROCESSOR_CLONES("avx2", "avx512f") void scale(Bins& bins, float factor) {
    for (std::size_t i = 0; i < Bins::padded; ++i)
        bins.value[i] *= factor;
}

OVERT_PROCESSOR_CLONES("avx2", "avx512f") void scale_or_drop(Bins& bins, float factor) {
    for (std::size_t i = 0; i < Bins::padded; ++i) {
        const float scaled = bins.value[i] * factor;
        bins.value[i] = scaled < 1e-30f ? 0.0f : scaled;
    }
}

OVERT_PROCESSOR_CLONES("avx2", "avx512f") void multiply(Bins& bins, const Bins& by) {
    for (std::size_t i = 0; i < Bins::padded; ++i)
        bins.value[i] *= by.value[i];
}

OVERT_PROCESSOR_CLONES("avx2", "avx512f")
void multiply_mixed(Bins& bins, const Bins& from, const Bins& to, float share) {
    for (std::size_t i = 0; i < Bins::padded; ++i)
        bins.value[i] *= from.value[i] + share * (to.value[i] - from.value[i]);
}

OVERT_PROCESSOR_CLONES("avx2", "avx512f") void absorb(Bins& bins, const Bins& absorbance, float path) {
    for (std::size_t i = 0; i < Bins::padded; ++i) {
        const float exponent = -1.44269504f * path * absorbance.value[i];
        bins.value[i] *= power_of_two(exponent < -125.0f ? -125.0f : exponent);
    }
}

OVERT_PROCESSOR_CLONES("avx2", "avx512f")
void multiply_by_flights(Bins& bins, const FlightChances& chances, float count, float length) {
    for (std::size_t i = 0; i < Bins::padded; ++i) {
        const float more = chances.coefficient.value[i] - chances.own_coefficient;
        float exponent =
            count * (chances.logarithm.value[i] - chances.own_logarithm) - 1.44269504f * length * more;
        // What is 2^60 times as likely as what has happened does not happen.
        exponent = exponent < -125.0f ? -125.0f : exponent;
        exponent = exponent > 60.0f ? 60.0f : exponent;
        bins.value[i] *= power_of_two(exponent);
    }
}

OVERT_PROCESSOR_CLONES("avx2", "avx512f")
void add_lit(Bins& sum, const Bins& bins, const RgbBasis& basis, glm::vec3 rgb) {
    const float r = rgb.x, g = rgb.y, b = rgb.z;
    for (std::size_t i = 0; i < Bins::padded; ++i) {
        sum.value[i] +=
            bins.value[i] * (r * basis[0].value[i] + g * basis[1].value[i] + b * basis[2].value[i]);
    }
}

OVERT_PROCESSOR_CLONES("avx2", "avx512f") void add(Bins& sum, const Bins& bins) {
    for (std::size_t i = 0; i < Bins::padded; ++i)
        sum.value[i] += bins.value[i];
}

} // namespace overt
