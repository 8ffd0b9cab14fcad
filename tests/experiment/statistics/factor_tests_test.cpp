/// Effects of factors within observers: the same as going through all exchanges one by one, and as the sign
/// flips of differences where two levels leave nothing else.
#include "experiment/statistics/factor_tests.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <catch2/catch.hpp>

#include "experiment/base/random.h"

using namespace overt;

namespace {

LevelMeans means_of(RandomStream& random, std::size_t levels, double effect) {
    LevelMeans means;
    const double own = random.normal();
    for (std::size_t level = 0; level < levels; ++level)
        means.emplace_back(own + random.normal() + (level == 0 ? effect : 0.0));
    return means;
}

std::vector<LevelMeans> observers_with(std::uint64_t seed, std::size_t count, std::size_t levels,
                                       double effect) {
    std::vector<LevelMeans> observers;
    for (std::size_t o = 0; o < count; ++o) {
        RandomStream random(seed, "made-up observers", o);
        observers.push_back(means_of(random, levels, effect));
    }
    return observers;
}

} // namespace

TEST_CASE("with two levels the exchange of levels is the sign flip of differences", "[unit]") {
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
        const std::vector<LevelMeans> observers = observers_with(seed, 9, 2, 0.8);
        std::vector<double> differences;
        double sum = 0.0;
        for (const LevelMeans& own : observers) {
            differences.push_back(*own[0] - *own[1]);
            sum += differences.back();
        }
        const auto exact = sign_flip_test(differences);
        const auto test = level_exchange_test(observers, {.permutations = 20000});
        REQUIRE(test);
        // Either level's mean is half the difference from the middle, and the other's as far on the other
        // side.
        CHECK(test->statistic == Approx(2.0 * sum * sum / 4.0 / 9.0));
        CHECK(test->test.p == Approx(exact->p).margin(4.0 * std::sqrt(exact->p * (1.0 - exact->p) / 20000)));
        CHECK(test->least_p == Approx(1.0 / 256.0));
        CHECK(test->observers == 9);
    }
}

TEST_CASE("random exchanges give the share of all exchanges that are as far from equal levels", "[unit]") {
    const std::vector<LevelMeans> observers = observers_with(5, 3, 3, 1.5);
    std::array<std::array<std::size_t, 3>, 6> orders{};
    std::array<std::size_t, 3> order{0, 1, 2};
    for (auto& one : orders) {
        one = order;
        std::ranges::next_permutation(order);
    }
    const auto statistic = [&](const std::array<std::size_t, 3>& a, const std::array<std::size_t, 3>& b,
                               const std::array<std::size_t, 3>& c) {
        double sum = 0.0;
        for (std::size_t level = 0; level < 3; ++level) {
            double mean = 0.0;
            const std::array<std::size_t, 3> at{a[level], b[level], c[level]};
            for (std::size_t o = 0; o < 3; ++o)
                mean +=
                    (*observers[o][at[o]] - (*observers[o][0] + *observers[o][1] + *observers[o][2]) / 3.0) /
                    3.0;
            sum += 3.0 * mean * mean;
        }
        return sum;
    };
    const double observed = statistic(orders[0], orders[0], orders[0]);
    int hits = 0;
    for (const auto& a : orders) {
        for (const auto& b : orders) {
            for (const auto& c : orders)
                hits += statistic(a, b, c) >= observed * (1.0 - 1e-9);
        }
    }
    const double exact = hits / 216.0;
    const auto test = level_exchange_test(observers, {.permutations = 20000});
    REQUIRE(test);
    CHECK(test->statistic == Approx(observed));
    CHECK(test->test.p == Approx(exact).margin(4.0 * std::sqrt(exact * (1.0 - exact) / 20000)));
    CHECK(test->least_p == Approx(1.0 / 36.0));
}

TEST_CASE("an interaction of two by two is the sign flip of the difference of differences", "[unit]") {
    std::vector<LevelMeans> observers = observers_with(7, 10, 4, 0.9);
    std::vector<double> contrasts;
    for (const LevelMeans& own : observers)
        contrasts.push_back(*own[0] - *own[1] - *own[2] + *own[3]);
    // One who lacks a cell does not take part.
    observers.push_back({1.0, std::nullopt, 3.0, 9.0});
    const auto test = interaction_flip_test(observers, 2);
    REQUIRE(test);
    CHECK(test->test.is_exact);
    CHECK(test->test.p == sign_flip_test(contrasts)->p);
    CHECK(test->observers == 10);
    CHECK(test->least_p == 2.0 / 1024.0);
}

TEST_CASE("what is the same in all observers' levels has no part in an interaction", "[unit]") {
    std::vector<LevelMeans> observers = observers_with(8, 6, 6, 0.0);
    const auto before = interaction_flip_test(observers, 3);
    for (LevelMeans& own : observers) {
        for (std::size_t cell = 0; cell < own.size(); ++cell) {
            const std::size_t row = cell / 3, column = cell % 3;
            *own[cell] += 5.0 * static_cast<double>(row) - 2.0 * static_cast<double>(column);
        }
    }
    const auto after = interaction_flip_test(observers, 3);
    CHECK(after->statistic == Approx(before->statistic));
    CHECK(after->test.p == before->test.p);
}

TEST_CASE("observers without two levels are left out, and one alone is no test", "[unit]") {
    std::vector<LevelMeans> observers{{1.0, std::nullopt, 2.0}, {std::nullopt, 5.0, std::nullopt}};
    CHECK_FALSE(level_exchange_test(observers));
    observers.push_back({std::nullopt, 1.0, 4.0});
    const auto test = level_exchange_test(observers);
    REQUIRE(test);
    CHECK(test->observers == 2);
    // Means less own mean: -0.5 and 0.5; -1.5 and 1.5. By level: -0.5 of one, -1.5 of one, 2.0 of two.
    CHECK(test->statistic == Approx(0.25 + 2.25 + 4.0 / 2.0));
    CHECK(test->least_p == Approx(0.25));
    CHECK_FALSE(interaction_flip_test(std::vector<LevelMeans>{}, 2));
}
