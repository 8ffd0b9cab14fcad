#include "experiment/statistics/permutation.h"

#include <cmath>
#include <vector>

#include <catch2/catch.hpp>

#include "experiment/base/random.h"
#include "experiment/statistics/cluster_test.h"

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

} // namespace
