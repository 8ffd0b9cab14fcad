#include "render/image/stored_values.h"

#include <catch2/catch.hpp>

#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

using namespace overt;

namespace {

std::vector<std::uint16_t> all_codes() {
    std::vector<std::uint16_t> codes(65536);
    std::iota(codes.begin(), codes.end(), std::uint16_t{0});
    return codes;
}

} // namespace

TEST_CASE("every half becomes the float that binary16 says it is", "[unit]") {
    const std::vector<std::uint16_t> halves = all_codes();
    std::vector<float> floats(halves.size());
    floats_of_halves(halves, floats);
    for (std::size_t i = 0; i < halves.size(); ++i) {
        const int sign = (i & 0x8000) ? -1 : 1, exponent = static_cast<int>(i >> 10) & 31,
                  fraction = static_cast<int>(i & 1023);
        if (exponent == 31) {
            CHECK((fraction == 0 ? std::isinf(floats[i]) : std::isnan(floats[i])));
            continue;
        }
        const double magnitude =
            exponent == 0 ? std::ldexp(fraction, -24) : std::ldexp(1024 + fraction, exponent - 25);
        if (static_cast<double>(floats[i]) != sign * magnitude)
            FAIL("half " << i << " became " << floats[i] << ", not " << sign * magnitude);
    }
}

TEST_CASE("a half that is not finite is noticed wherever it stands", "[unit]") {
    for (const std::size_t count : {1u, 7u, 8u, 9u, 30u}) {
        std::vector<float> floats(count);
        for (std::size_t place = 0; place < count; ++place) {
            std::vector<std::uint16_t> halves(count, 0x7bff); // the greatest finite one
            CHECK(floats_of_halves(halves, floats));
            for (const int bad : {0x7c00, 0xfc00, 0x7e01}) {
                halves[place] = static_cast<std::uint16_t>(bad);
                CHECK_FALSE(floats_of_halves(halves, floats));
            }
        }
    }
}

TEST_CASE("a float that is not finite is noticed", "[unit]") {
    std::vector<float> values(13, std::numeric_limits<float>::max());
    CHECK(all_finite(values));
    values[12] = std::numeric_limits<float>::infinity();
    CHECK_FALSE(all_finite(values));
    values[12] = std::numeric_limits<float>::quiet_NaN();
    CHECK_FALSE(all_finite(values));
}

TEST_CASE("a looked-up sRGB code is the light that the formula gives", "[unit]") {
    const std::vector<std::uint16_t> codes = all_codes();
    std::vector<float> values(codes.size());
    floats_of_codes(codes, values);
    for (std::size_t i = 0; i < codes.size(); ++i) {
        const double value = static_cast<double>(i) / 65535.0;
        const double light = value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
        if (std::abs(static_cast<double>(linear_from_srgb_code(values[i])) - light) > 1e-6)
            FAIL("code " << i << " became " << linear_from_srgb_code(values[i]) << ", not " << light);
    }
    CHECK(linear_from_srgb_code(1.0f) == 1.0f);
    CHECK(linear_from_srgb_code(0.0f) == 0.0f);
}
