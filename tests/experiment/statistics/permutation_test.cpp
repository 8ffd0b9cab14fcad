#include "experiment/statistics/permutation.h"

#include <cmath>
#include <vector>

#include <catch2/catch.hpp>

#include "experiment/base/random.h"
#include "experiment/statistics/cluster_test.h"
#include "experiment/statistics/threshold_free.h"

namespace {

using namespace overt;
using Values = std::vector<double>;

TEST_CASE("the exact test is that of scipy.stats.permutation_test", "[unit]") {
    const Values differences{0.3, -0.1, 0.8, 0.5, 1.1, -0.4, 0.9, 0.2};
    const TestResult flips = *sign_flip_test(differences);
    CHECK(flips.p == Approx(0.078125));
    CHECK(flips.is_exact);
    CHECK(flips.permutations == 256);
}

TEST_CASE("random flips come to the exact p, and never to 0", "[unit]") {
    const Values differences{0.3, -0.1, 0.8, 0.5, 1.1, -0.4, 0.9, 0.2};
    const TestResult random = *sign_flip_test(differences, {20000, 10, 3});
    CHECK_FALSE(random.is_exact);
    CHECK(random.p == Approx(0.078125).margin(0.01));
    CHECK(sign_flip_test(Values(40, 1.0), {99, 10, 3})->p == Approx(0.01));
    CHECK_FALSE(sign_flip_test({}));
    CHECK_FALSE(sign_flip_test(Values{0.7}));
}

TEST_CASE("sign flips find a true effect of 0 in 5 % of studies", "[unit]") {
    int found = 0;
    for (int study = 0; study < 1000; ++study) {
        RandomStream random(2, "null", static_cast<std::uint64_t>(study));
        Values differences;
        for (int i = 0; i < 10; ++i)
            differences.push_back(random.normal());
        found += sign_flip_test(differences)->p <= 0.05;
    }
    CHECK(found == Approx(50).margin(21)); // three standard deviations of 1000 throws
}

TEST_CASE("p values for several tests are corrected after Holm", "[unit]") {
    // R: p.adjust(c(.01, .04, .03, .005, .2), "holm").
    const Values p{0.01, 0.04, 0.03, 0.005, 0.2};
    const Values corrected = holm(p), expected{0.04, 0.09, 0.09, 0.025, 0.2};
    for (std::size_t i = 0; i < p.size(); ++i)
        CHECK(corrected[i] == Approx(expected[i]));
    CHECK(p_of_least(0.3, Values{0.1, 0.2, 0.4, 0.5}) == Approx(0.6));
}

/// A band of vertices, each next to the one before and after it.
struct Band {
    std::vector<std::uint32_t> begin, neighbours;
    Values areas;
    explicit Band(std::uint32_t length) : areas(length, 2.0) {
        begin.push_back(0);
        for (std::uint32_t v = 0; v < length; ++v) {
            if (v > 0)
                neighbours.push_back(v - 1);
            if (v + 1 < length)
                neighbours.push_back(v + 1);
            begin.push_back(static_cast<std::uint32_t>(neighbours.size()));
        }
    }
    Adjacency adjacency() const { return {begin, neighbours}; }
};

std::vector<std::vector<float>> noise(std::size_t observers, std::size_t places, std::uint64_t seed) {
    std::vector<std::vector<float>> maps(observers, std::vector<float>(places));
    for (std::size_t o = 0; o < observers; ++o) {
        RandomStream random(seed, "noise", o);
        for (float& value : maps[o])
            value = static_cast<float>(random.normal());
    }
    return maps;
}

TEST_CASE("a planted cluster is found where it was planted, and nothing elsewhere", "[unit]") {
    const Band band(200);
    auto maps = noise(10, 200, 4);
    for (auto& map : maps) {
        for (std::size_t v = 80; v < 100; ++v)
            map[v] -= 2.5f;
    }
    const ClusterTest test = cluster_test(maps, band.areas, band.adjacency(), {});
    CHECK(test.is_exact);
    CHECK(test.threshold_t == Approx(2.2621571627)); // scipy.stats.t.ppf(.975, 9)
    REQUIRE_FALSE(test.clusters.empty());
    const Cluster& first = test.clusters.front();
    CHECK(first.mass < 0.0);
    CHECK(first.p <= 0.01);
    CHECK(first.vertices.size() >= 15);
    CHECK(first.vertices.front() >= 79);
    CHECK(first.vertices.back() <= 101);
    CHECK(first.area == Approx(2.0 * static_cast<double>(first.vertices.size())));
    for (std::size_t i = 1; i < test.clusters.size(); ++i)
        CHECK(test.clusters[i].p > 0.05);
    // scipy.stats.ttest_1samp by hand: t of one vertex.
    double sum = 0.0, squares = 0.0;
    for (const auto& map : maps) {
        sum += static_cast<double>(map[90]);
        squares += static_cast<double>(map[90]) * static_cast<double>(map[90]);
    }
    const double mean = sum / 10.0, deviation = std::sqrt((squares - 10.0 * mean * mean) / 9.0);
    CHECK(static_cast<double>(test.t[90]) == Approx(mean / (deviation / std::sqrt(10.0))).epsilon(1e-5));
}

TEST_CASE("without a difference a cluster is found anywhere in 5 % of studies", "[unit]") {
    const Band band(60);
    int found = 0;
    for (std::uint64_t study = 0; study < 300; ++study) {
        const ClusterTest test = cluster_test(noise(8, 60, 100 + study), band.areas, band.adjacency(), {});
        found += !test.clusters.empty() && test.clusters.front().p <= 0.05;
    }
    CHECK(found <= 15 + 12); // three standard deviations of 300 throws above 5 %
    CHECK(found >= 3);
}

TEST_CASE("clusters do not depend on the number of threads, nor on vertices without area", "[unit]") {
    Band band(100);
    band.areas[50] = 0.0;
    auto maps = noise(16, 100, 9);
    for (auto& map : maps) {
        map[50] = 100.0f;
        for (std::size_t v = 10; v < 20; ++v)
            map[v] += 1.0f;
    }
    ClusterTestSettings settings;
    settings.permutations = 200;
    settings.most_exact = 100;
    settings.most_threads = 1;
    const ClusterTest one = cluster_test(maps, band.areas, band.adjacency(), settings);
    settings.most_threads = 3;
    const ClusterTest three = cluster_test(maps, band.areas, band.adjacency(), settings);
    CHECK_FALSE(one.is_exact);
    REQUIRE(one.clusters.size() == three.clusters.size());
    for (std::size_t i = 0; i < one.clusters.size(); ++i) {
        CHECK(one.clusters[i].p == three.clusters[i].p);
        CHECK(one.clusters[i].mass == three.clusters[i].mass);
        CHECK(one.clusters[i].p >= 1.0 / 200.0);
    }
    CHECK(one.t == three.t);
    CHECK(one.t[50] == 0.0f);
}

TEST_CASE("over several maps p is that of the largest cluster of any, and can be as small as of one",
          "[unit]") {
    const Band band(60);
    // Eight observers, twenty maps, of which one has a difference that all of them share, on a small object.
    Band small(60);
    for (double& area : small.areas)
        area *= 0.01;
    std::vector<ClusterTest> tests;
    ClusterTestSettings settings;
    settings.all_observers = 8;
    for (std::uint64_t map = 0; map < 20; ++map) {
        std::vector<std::vector<float>> maps = noise(8, 60, 500 + map);
        for (std::vector<float>& one : maps) {
            for (std::size_t v = 20; map == 7 && v < 40; ++v)
                one[v] += 3.0f;
        }
        settings.observers = {0, 1, 2, 3, 4, 5, 6, 7};
        if (map == 3) { // two did not take part
            maps.resize(6);
            settings.observers = {0, 2, 3, 5, 6, 7};
        }
        const Band& on = map == 7 ? small : band;
        tests.push_back(cluster_test(maps, on.areas, on.adjacency(), settings));
        CHECK(tests.back().permutations == 128);
        CHECK(tests.back().least_p == (map == 3 ? 1.0 / 32.0 : 1.0 / 128.0));
    }
    const auto p = p_over_tests(tests);
    REQUIRE(p.size() == 20);
    CHECK(p[7].front() == 1.0 / 128.0); // after Bonferroni 20 / 128
    for (std::size_t map = 0; map < 20; ++map) {
        REQUIRE(p[map].size() == tests[map].clusters.size());
        for (std::size_t i = 0; i < p[map].size(); ++i) {
            CHECK(p[map][i] >= tests[map].clusters[i].p);
            CHECK(tests[map].clusters[i].p >= tests[map].least_p);
            if (map != 7)
                CHECK(p[map][i] > 0.05);
        }
    }
}

TEST_CASE("flips that are shared with others give a map the p of its own flips", "[unit]") {
    const Band band(60);
    const auto maps = noise(5, 60, 9);
    ClusterTestSettings shared;
    shared.observers = {1, 3, 4, 6, 8};
    shared.all_observers = 10;
    const ClusterTest own = cluster_test(maps, band.areas, band.adjacency(), {}),
                      others = cluster_test(maps, band.areas, band.adjacency(), shared);
    REQUIRE(!own.clusters.empty());
    REQUIRE(others.clusters.size() == own.clusters.size());
    for (std::size_t i = 0; i < own.clusters.size(); ++i)
        CHECK(others.clusters[i].p == own.clusters[i].p);
    // Random flips of many may by chance be fewer of these five; no p is below what five can give.
    shared.all_observers = 40;
    shared.permutations = 200;
    for (shared.seed = 1; shared.seed < 20; ++shared.seed) {
        for (const Cluster& cluster : cluster_test(maps, band.areas, band.adjacency(), shared).clusters)
            CHECK(cluster.p >= 1.0 / 16.0);
    }
}

TEST_CASE("over ten maps without a difference few studies find a cluster in any", "[unit]") {
    const Band band(40);
    int found = 0;
    constexpr int studies = 100;
    for (std::uint64_t study = 0; study < studies; ++study) {
        std::vector<ClusterTest> tests;
        for (std::uint64_t map = 0; map < 10; ++map)
            tests.push_back(
                cluster_test(noise(7, 40, 1000 + 10 * study + map), band.areas, band.adjacency(), {}));
        bool any = false;
        for (const std::vector<double>& of_map : p_over_tests(tests)) {
            for (const double p : of_map)
                any = any || p <= 0.05;
        }
        found += any;
    }
    // p in steps of 1 / 64: 3 of 64, of 100 studies 4.7; no more than 13 with probability 0.999.
    CHECK(found <= 13);
    CHECK(found >= 1);
}

} // namespace

TEST_CASE("a value without a threshold is the integral over heights of what hangs together there", "[unit]") {
    const Band band(120); // each vertex has an area of 2
    const Adjacency adjacency = band.adjacency();
    ThresholdFree free(adjacency, band.areas);
    std::vector<float> t(120, 0.0f), enhanced;
    // Alone: sqrt(2) t^3 / 3; two alike: sqrt(4) t^3 / 3; a lower neighbour has the higher one for company.
    t[3] = 3.0f;
    t[10] = t[11] = -2.0f;
    t[20] = 3.0f;
    t[21] = 1.0f;
    CHECK(free.enhance(t, &enhanced) == Approx(std::sqrt(2.0) * 26.0 / 3.0 + std::sqrt(4.0) / 3.0));
    CHECK(enhanced[3] == Approx(std::sqrt(2.0) * 27.0 / 3.0));
    CHECK(enhanced[10] == Approx(-std::sqrt(4.0) * 8.0 / 3.0));
    CHECK(enhanced[11] == enhanced[10]);
    CHECK(enhanced[20] == Approx(std::sqrt(2.0) * 26.0 / 3.0 + std::sqrt(4.0) / 3.0));
    CHECK(enhanced[21] == Approx(std::sqrt(4.0) / 3.0));
    CHECK(enhanced[50] == 0.0f);
    // Of any map, by steps of the height.
    RandomStream random(6, "heights");
    for (float& value : t)
        value = static_cast<float>(random.normal());
    const double largest = free.enhance(t, &enhanced);
    constexpr double step = 0.0005;
    double most = 0.0;
    for (std::size_t v = 0; v < t.size(); ++v) {
        const double sign = t[v] < 0.0f ? -1.0 : 1.0;
        double sum = 0.0;
        for (double h = 0.5 * step; h < sign * static_cast<double>(t[v]); h += step) {
            std::size_t begin = v, end = v;
            while (begin > 0 && sign * static_cast<double>(t[begin - 1]) >= h)
                --begin;
            while (end + 1 < t.size() && sign * static_cast<double>(t[end + 1]) >= h)
                ++end;
            sum += std::sqrt(2.0 * static_cast<double>(end - begin + 1)) * h * h * step;
        }
        CHECK(static_cast<double>(enhanced[v]) == Approx(sign * sum).epsilon(0.01).margin(0.001));
        most = std::max(most, sum);
    }
    CHECK(largest == Approx(most).epsilon(0.01));
}

TEST_CASE("without a threshold a planted difference has a small p, and noise in 5 % of studies", "[unit]") {
    const Band band(60);
    ClusterTestSettings settings;
    settings.threshold_free = true;
    auto maps = noise(10, 60, 4);
    for (auto& map : maps)
        for (std::size_t v = 20; v < 40; ++v)
            map[v] -= 2.0f;
    const ClusterTest planted = cluster_test(maps, band.areas, band.adjacency(), settings);
    REQUIRE(planted.free_p.size() == 60);
    CHECK(planted.free_p[30] <= 0.01f);
    CHECK(static_cast<double>(planted.free_p[30]) >= planted.least_p);
    CHECK(planted.free_p[5] > 0.05f);
    CHECK(cluster_test(maps, band.areas, band.adjacency(), {}).free_p.empty());
    int found = 0;
    for (std::uint64_t study = 0; study < 300; ++study) {
        const ClusterTest test =
            cluster_test(noise(8, 60, 100 + study), band.areas, band.adjacency(), settings);
        found += *std::ranges::min_element(test.free_p) <= 0.05f;
    }
    CHECK(found <= 15 + 12); // three standard deviations of 300 throws above 5 %
    CHECK(found >= 3);
}
