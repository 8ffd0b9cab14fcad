#include "experiment/base/number_text.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include <catch2/catch.hpp>

#include "experiment/base/random.h"

using namespace overt;

namespace {

std::string scaled(std::int64_t number, int decimals) {
    std::string text;
    append_scaled(text, number, decimals);
    return text;
}

std::string fixed(double number, int decimals) {
    std::string text;
    append_fixed(text, number, decimals);
    return text;
}

} // namespace

TEST_CASE("whole numbers of a decimal place keep their sign, their zeros and all their digits", "[unit]") {
    CHECK(scaled(12345, 3) == "12.345");
    CHECK(scaled(-12345, 3) == "-12.345");
    CHECK(scaled(-5, 3) == "-0.005");
    CHECK(scaled(5, 0) == "5");
    CHECK(scaled(-70, 1) == "-7.0");
    CHECK(scaled(0, 2) == "0.00");
    CHECK(scaled(std::numeric_limits<std::int64_t>::max(), 9) == "9223372036.854775807");
    CHECK(scaled(std::numeric_limits<std::int64_t>::min(), 9) == "-9223372036.854775808");
}

TEST_CASE("numbers are rounded half away from zero", "[unit]") {
    CHECK(fixed(0.5, 0) == "1");
    CHECK(fixed(-0.5, 0) == "-1");
    CHECK(fixed(1.25, 1) == "1.3");
    CHECK(fixed(-1.25, 1) == "-1.3");
    CHECK(fixed(1.9996, 3) == "2.000");
    CHECK(fixed(-3.14159, 4) == "-3.1416");
    CHECK(fixed(2.0 / 3.0, 9) == "0.666666667");
    CHECK(fixed(1e17, 2) == "100000000000000000.00");
    CHECK(fixed(-1e17, 1) == "-100000000000000000.0");
}

TEST_CASE("a number's text is within half of its last place", "[unit]") {
    RandomStream random(5, "numbers");
    for (int i = 0; i < 5000; ++i) {
        const double number = random.uniform(-4000.0, 4000.0);
        for (const int decimals : {0, 1, 3, 6}) {
            const double half = 0.5 * std::pow(10.0, -decimals);
            REQUIRE(std::abs(std::stod(fixed(number, decimals)) - number) <= half * (1.0 + 1e-9));
        }
    }
}

TEST_CASE("the shortest decimal of a float is that float again, and what was written", "[unit]") {
    CHECK(shortest_decimal(2338.6f) == 2338.6);
    CHECK(shortest_decimal(-0.1f) == -0.1);
    CHECK(shortest_decimal(1e-7f) == 1e-7);
    RandomStream random(6, "floats");
    for (int i = 0; i < 5000; ++i) {
        const auto number = static_cast<float>(random.uniform(-3000.0, 3000.0));
        REQUIRE(static_cast<float>(shortest_decimal(number)) == number);
    }
}
