/// Maps of differences with planted ones, and with none.
#include <catch2/catch.hpp>

#include "experiment/study/difference_maps.h"
#include "tests/experiment/study/painted_study.h"

using namespace overt;

namespace {

std::vector<DifferenceMap> differences_of(const test::PaintedStudy& study) {
    return difference_maps(study.results, fixation_maps(study.results, study.surfaces), {}, study.options);
}

} // namespace

TEST_CASE("a planted difference is found where it was planted, with its size", "[unit]") {
    // In the second level half of the fixations go to the top, in the first one none.
    const test::PaintedStudy study(8, 2, 20, [](int, int level, RandomStream& random) {
        const bool is_up = level == 1 && random.uniform() < 0.5;
        return test::near(is_up ? test::top : test::front, 0.15, random);
    });
    const auto maps = differences_of(study);
    REQUIRE(maps.size() == 1);
    const DifferenceMap& map = maps.front();
    CHECK(map.observers == 8);
    CHECK(map.least_p == Approx(1.0 / 128.0)); // 2^8 sign flips, each with its mirror image
    REQUIRE(map.clusters.size() >= 2);
    bool found_top = false, found_front = false;
    // Levels without a protocol's list come by the alphabet: rough less smooth.
    CHECK(map.a == "rough");
    for (const DifferenceMap::Cluster& cluster : map.clusters) {
        if (cluster.p > 0.05)
            continue;
        const glm::dvec3 towards = glm::normalize(cluster.centroid_mm);
        if (glm::dot(towards, test::top) > 0.9) {
            found_top = true;
            CHECK(cluster.mass > 0.0);
            CHECK(cluster.part == PartIndex{1});
            CHECK(cluster.difference == Approx(0.5).margin(0.12));
        } else if (glm::dot(towards, test::front) > 0.9) {
            found_front = true;
            CHECK(cluster.mass < 0.0);
            CHECK(cluster.difference == Approx(-0.5).margin(0.12));
        }
    }
    CHECK(found_top);
    CHECK(found_front);
    // What one level has more the other has less.
    const std::vector<double> areas = study.surfaces[0].areas_mm2;
    double sum = 0.0;
    for (std::size_t v = 0; v < areas.size(); ++v)
        sum += areas[v] * static_cast<double>(map.difference[v]);
    CHECK(sum == Approx(0.0).margin(1e-5));
    // Each vertex of a cluster knows its number.
    CHECK(*std::max_element(map.cluster.begin(), map.cluster.end()) == map.clusters.size());
}

TEST_CASE("without a difference hardly any study finds a cluster", "[unit]") {
    int found = 0;
    constexpr int studies = 16;
    for (std::uint64_t seed = 1; seed <= studies; ++seed) {
        const test::PaintedStudy study(
            6, 2, 8, [](int, int, RandomStream& random) { return test::near(test::front, 0.5, random); },
            seed);
        for (const DifferenceMap& map : differences_of(study)) {
            for (const DifferenceMap::Cluster& cluster : map.clusters) {
                if (cluster.p_of_all <= 0.05) {
                    ++found;
                    break;
                }
            }
        }
    }
    // With p in steps of 1 / 32 one of 32 studies is expected to; four of 16 come once in 700 cases.
    CHECK(found < 4);
}

TEST_CASE("too few observers for a small p are counted, one alone has no map", "[unit]") {
    const auto look = [](int, int, RandomStream& random) { return test::near(test::front, 0.3, random); };
    const auto four = differences_of(test::PaintedStudy(4, 2, 6, look));
    REQUIRE(four.size() == 1);
    CHECK(four.front().least_p == 0.125);
    for (const DifferenceMap::Cluster& cluster : four.front().clusters)
        CHECK(cluster.p >= 0.125);
    const auto one = differences_of(test::PaintedStudy(1, 2, 6, look));
    REQUIRE(one.size() == 1);
    CHECK(one.front().difference.empty());
    CHECK(one.front().absent == "one observer alone saw it in both levels");
    CHECK(differences_of(test::PaintedStudy(3, 1, 6, look)).empty());
}
