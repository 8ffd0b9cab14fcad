#include "render/image/stored_values.h"

#include <bit>
#include <cmath>
#include <vector>

#include "experiment/base/error.h"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace overt {

namespace {

/// IEEE 754-2008, table 3.5: sign, 5 bits of exponent with bias 15, 10 of fraction.
float float_of_half(std::uint16_t half) {
    const int exponent = (half >> 10) & 31, fraction = half & 1023;
    const float sign = (half & 0x8000) ? -1.0f : 1.0f;
    if (exponent == 31)
        return fraction == 0 ? sign * HUGE_VALF : std::bit_cast<float>(0x7fc00000u);
    if (exponent == 0)
        return sign * std::ldexp(static_cast<float>(fraction), -24);
    return sign * std::ldexp(static_cast<float>(fraction + 1024), exponent - 25);
}

/// All of its bits set: infinite, or not a number.
constexpr std::uint16_t half_exponent = 0x7c00;

/// For processors that have no instruction for it.
bool look_up_halves(std::span<const std::uint16_t> halves, float* into) {
    static const std::vector<float> table = [] {
        std::vector<float> floats;
        for (unsigned half = 0; half < 65536; ++half)
            floats.push_back(float_of_half(static_cast<std::uint16_t>(half)));
        return floats;
    }();
    bool finite = true;
    for (const std::uint16_t half : halves) {
        *into++ = table[half];
        finite = finite && (half & half_exponent) != half_exponent;
    }
    return finite;
}

#if defined(__x86_64__)
/// Eight at a time, as many as make whole eights.
__attribute__((target("avx,f16c"))) bool convert_eights(std::span<const std::uint16_t> halves, float* into) {
    const __m128i exponent = _mm_set1_epi16(half_exponent);
    __m128i bad = _mm_setzero_si128();
    for (std::size_t i = 0; i + 8 <= halves.size(); i += 8) {
        const __m128i eight = _mm_loadu_si128(reinterpret_cast<const __m128i*>(halves.data() + i));
        bad = _mm_or_si128(bad, _mm_cmpeq_epi16(_mm_and_si128(eight, exponent), exponent));
        _mm256_storeu_ps(into + i, _mm256_cvtph_ps(eight));
    }
    return _mm_movemask_epi8(bad) == 0;
}
#endif

} // namespace

bool all_finite(std::span<const float> values) noexcept {
    constexpr std::uint32_t exponent = 0x7f800000u; // all of its bits set: infinite, or not a number
    std::uint32_t bad = 0;
    for (const float value : values)
        bad |= static_cast<std::uint32_t>((std::bit_cast<std::uint32_t>(value) & exponent) == exponent);
    return bad == 0;
}

bool floats_of_halves(std::span<const std::uint16_t> halves, std::span<float> into) {
    OVERT_EXPECTS(into.size() == halves.size());
    std::size_t done = 0;
    bool finite = true;
#if defined(__x86_64__)
    // Each processor with AVX2 has F16C, a name that not every compiler knows here.
    if (__builtin_cpu_supports("avx2")) {
        finite = convert_eights(halves, into.data());
        done = halves.size() / 8 * 8;
    }
#endif
    return look_up_halves(halves.subspan(done), into.data() + done) && finite;
}

void floats_of_codes(std::span<const std::uint16_t> codes, std::span<float> into) noexcept {
    OVERT_EXPECTS(into.size() == codes.size());
    for (std::size_t i = 0; i < codes.size(); ++i)
        into[i] = static_cast<float>(codes[i]) / 65535.0f;
}

float linear_from_srgb(float value) noexcept {
    return value <= 0.04045f ? value / 12.92f : std::pow((value + 0.055f) / 1.055f, 2.4f);
}

float srgb_from_linear(float value) noexcept {
    return value <= 0.0031308f ? 12.92f * value : 1.055f * std::pow(value, 1.0f / 2.4f) - 0.055f;
}

float linear_from_srgb_code(float value) noexcept {
    static const std::vector<float> table = [] {
        std::vector<float> light;
        for (int code = 0; code < 65536; ++code)
            light.push_back(linear_from_srgb(static_cast<float>(code) / 65535.0f));
        return light;
    }();
    return table[static_cast<std::size_t>(value * 65535.0f + 0.5f)];
}

} // namespace overt
