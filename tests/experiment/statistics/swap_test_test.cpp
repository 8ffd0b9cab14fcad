/// Swaps of whole maps within observers: the same as adding up maps and correlating them, one by one.
#include <catch2/catch.hpp>

#include "experiment/base/random.h"
#include "experiment/statistics/map_similarity.h"
#include "experiment/statistics/swap_test.h"

using namespace overt;

namespace {

constexpr std::size_t places = 40;

using Map = std::vector<double>;

struct BothMaps {
    Map a, b;
};

/// Maps of observers that have much in common, a more at the first places by `effect`.
std::vector<BothMaps> made_up_maps(std::size_t observers, std::uint64_t seed, double effect) {
    std::vector<BothMaps> maps;
    for (std::size_t o = 0; o < observers; ++o) {
        RandomStream random(seed, "made-up maps", o);
        BothMaps both{Map(places), Map(places)};
        for (std::size_t i = 0; i < places; ++i) {
            const auto common = static_cast<double>(i % 7);
            both.a[i] = common + 3.0 * random.uniform() + (i < 10 ? effect : 0.0);
            both.b[i] = common + 3.0 * random.uniform();
        }
        maps.push_back(std::move(both));
    }
    return maps;
}

Map areas_of_places() {
    Map areas;
    for (std::size_t i = 0; i < places; ++i)
        areas.push_back(0.5 + 0.1 * static_cast<double>(i % 5));
    return areas;
}

PairedMaps paired(const std::vector<BothMaps>& maps, const Map& areas) {
    PairedMaps all(areas);
    for (std::size_t o = 0; o < maps.size(); ++o)
        all.add(o, maps[o].a, maps[o].b);
    return all;
}

/// The correlation of both sums when those observers are swapped whose bit is set.
double correlation_of_sums(const std::vector<BothMaps>& maps, const Map& areas, std::uint64_t swapped) {
    Map a(places), b(places);
    for (std::size_t o = 0; o < maps.size(); ++o) {
        const bool is_swapped = swapped >> o & 1u;
        for (std::size_t i = 0; i < places; ++i) {
            a[i] += is_swapped ? maps[o].b[i] : maps[o].a[i];
            b[i] += is_swapped ? maps[o].a[i] : maps[o].b[i];
        }
    }
    return *correlation(a, b, areas);
}

} // namespace

TEST_CASE("swaps of maps give the correlations of the maps added up, and count them all", "[unit]") {
    const Map areas = areas_of_places();
    const auto one = made_up_maps(6, 1, 0.4), other = made_up_maps(6, 2, 0.0);
    const PairedMaps surfaces[] = {paired(one, areas), paired(other, areas)};
    const auto mean = [&](std::uint64_t swapped) {
        return 0.5 * (correlation_of_sums(one, areas, swapped) + correlation_of_sums(other, areas, swapped));
    };
    int hits = 0;
    for (std::uint64_t swapped = 0; swapped < 64; ++swapped)
        hits += mean(swapped) <= mean(0) + 1e-9;
    const auto test = swap_test(surfaces, 6);
    REQUIRE(test);
    CHECK(test->correlation == Approx(mean(0)).margin(1e-12));
    CHECK(test->test.is_exact);
    CHECK(test->test.p == Approx(hits / 64.0).margin(1e-12));

    // The first four alone are a study of four.
    const PairedMaps of_four[] = {paired({one.begin(), one.begin() + 4}, areas),
                                  paired({other.begin(), other.begin() + 4}, areas)};
    CHECK(swap_test(surfaces, 4)->correlation == swap_test(of_four, 4)->correlation);
    CHECK(swap_test(surfaces, 4)->test.p == swap_test(of_four, 4)->test.p);
}

TEST_CASE("swaps of maps find no difference in 5 % of studies without one, and a planted one", "[unit]") {
    const Map areas = areas_of_places();
    int found = 0, found_planted = 0;
    constexpr int studies = 400;
    for (std::uint64_t study = 0; study < studies; ++study) {
        const PairedMaps null[] = {paired(made_up_maps(8, 100 + study, 0.0), areas)},
                         planted[] = {paired(made_up_maps(8, 100 + study, 2.0), areas)};
        found += swap_test(null, 8)->test.p <= 0.05;
        found_planted += swap_test(planted, 8)->test.p <= 0.05;
    }
    // 5 % of 400 is 20; scipy.stats.binom.ppf(0.999, 400, 0.05) is 35 and of 0.001 it is 8.
    CHECK(found <= 35);
    CHECK(found >= 8);
    CHECK(found_planted == studies);
}

TEST_CASE("many observers are swapped at random, and maps that are constant have no test", "[unit]") {
    const Map areas = areas_of_places();
    const PairedMaps many[] = {paired(made_up_maps(20, 5, 0.5), areas)};
    const auto test = swap_test(many, 20, {500, 1000, 3});
    REQUIRE(test);
    CHECK_FALSE(test->test.is_exact);
    CHECK(test->test.permutations == 500);
    CHECK(test->test.p >= 1.0 / 501.0);

    PairedMaps flat(areas);
    flat.add(0, Map(places, 1.0), Map(places, 2.0));
    CHECK_FALSE(swap_test(std::span(&flat, 1), 1));
    CHECK_FALSE(swap_test({}, 3));
}

TEST_CASE("one observer's levels are as likely the other way round, which is no test", "[unit]") {
    const std::vector<double> areas(6, 1.0);
    PairedMaps alone(areas);
    alone.add(2, std::vector<double>{1, 2, 3, 4, 5, 6}, std::vector<double>{6, 5, 1, 2, 2, 9});
    CHECK_FALSE(swap_test(std::vector{alone}, 3));
    alone.add(3, std::vector<double>{1, 2, 3, 4, 5, 7}, std::vector<double>{6, 5, 1, 2, 3, 9});
    CHECK(swap_test(std::vector{alone}, 4));
}
