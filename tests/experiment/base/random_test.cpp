/// Random numbers: their distributions, held to known moments and shares.
#include "experiment/base/random.h"

#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

using namespace overt;

namespace {

constexpr int draws = 200'000;

/// Mean, variance and the fourth central moment over the variance squared.
struct Moments {
    double mean = 0.0, variance = 0.0, kurtosis = 0.0;
};

template <class Draw> Moments moments_of(const Draw& draw) {
    double sums[5] = {};
    for (int i = 0; i < draws; ++i) {
        double power = 1.0;
        const double value = draw();
        for (double& sum : sums) {
            sum += power / draws;
            power *= value;
        }
    }
    Moments moments;
    const double m = moments.mean = sums[1];
    moments.variance = sums[2] - m * m;
    moments.kurtosis = (sums[4] - 4.0 * m * sums[3] + 6.0 * m * m * sums[2] - 3.0 * m * m * m * m) /
                       (moments.variance * moments.variance);
    return moments;
}

} // namespace

TEST_CASE("normal deviates have mean 0, variance 1 and kurtosis 3", "[unit]") {
    RandomStream random(11, "normal");
    const Moments found = moments_of([&] { return random.normal(); });
    // Five standard errors: 1, 1.4 and 4.9 over the root of the draws.
    CHECK(found.mean == Approx(0.0).margin(0.012));
    CHECK(found.variance == Approx(1.0).margin(0.016));
    CHECK(found.kurtosis == Approx(3.0).margin(0.055));
}

TEST_CASE("uniform and exponential numbers have their distributions' moments", "[unit]") {
    RandomStream random(12, "others");
    const Moments uniform = moments_of([&] { return random.uniform(); });
    CHECK(uniform.mean == Approx(0.5).margin(0.0033));
    CHECK(uniform.variance == Approx(1.0 / 12.0).margin(0.0009));
    CHECK(uniform.kurtosis == Approx(1.8).margin(0.02));
    const Moments exponential = moments_of([&] { return random.exponential(3.0); });
    CHECK(exponential.mean == Approx(3.0).margin(0.034));
    CHECK(exponential.variance == Approx(9.0).margin(0.3));
    CHECK(exponential.kurtosis == Approx(9.0).margin(1.5));
}

TEST_CASE("numbers below a limit are equally likely, also where the limit divides no power of two",
          "[unit]") {
    RandomStream random(13, "below");
    // Three quarters of 2^32: a product's high word alone would give each third number twice as often.
    constexpr std::uint32_t limit = 3u << 30;
    int thirds[3] = {};
    for (int i = 0; i < draws; ++i) {
        const std::uint32_t number = random.below(limit);
        REQUIRE(number < limit);
        ++thirds[number % 3];
    }
    // Five standard deviations of a binomial count.
    for (const int count : thirds)
        CHECK(count == Approx(draws / 3.0).margin(5.0 * std::sqrt(draws * 2.0 / 9.0)));
    int sevenths[7] = {};
    for (int i = 0; i < draws; ++i)
        ++sevenths[random.below(7)];
    for (const int count : sevenths)
        CHECK(count == Approx(draws / 7.0).margin(5.0 * std::sqrt(draws * 6.0 / 49.0)));
}
