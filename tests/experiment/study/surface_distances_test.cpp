/// Ways along a ball between many places, against the arcs of great circles.
#include "experiment/study/surface_distances.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <catch2/catch.hpp>

#include "experiment/study/observer_similarities.h"
#include "tests/experiment/study/painted_study.h"

using namespace overt;

TEST_CASE("ways between any two of many places of a ball are arcs of great circles", "[unit]") {
    test::PaintedStudy study(1, 1, 80,
                             [](int, int, RandomStream& random) { return test::near({}, 1.0, random); });
    const SurfaceDistances distances(study.results, 0, study.surfaces[0]);
    const std::vector<StudyFixation>& fixations = study.results.fixations;
    double longest = 0.0;
    for (std::size_t i = 0; i < fixations.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
            CAPTURE(i, j);
            const double cosine =
                glm::dot(glm::normalize(fixations[i].position), glm::normalize(fixations[j].position));
            const double arc = 100.0 * std::acos(std::clamp(cosine, -1.0, 1.0));
            CHECK(distances.between(fixations[i], fixations[j]) == Approx(arc).epsilon(0.04).margin(0.5));
            CHECK(distances.between(fixations[j], fixations[i]) ==
                  Approx(distances.between(fixations[i], fixations[j])).epsilon(0.02).margin(1e-3));
            longest = std::max(longest, arc);
        }
    CHECK(distances.extent_mm() == Approx(longest).epsilon(0.04));
    const StudyFixation unknown;
    CHECK(std::isinf(distances.between(fixations[0], unknown)));
}

TEST_CASE("what fixations cover is a share of what can be seen, on small objects, too", "[unit]") {
    test::PaintedStudy study(1, 1, 1, [](int, int, RandomStream&) { return test::front; });
    // A ball of 1 mm: its vertices stand for hundredths of a square millimetre.
    study.surfaces[0].geometry = std::make_unique<SurfaceGeometry>(*study.results.objects[0].mesh, 0.01);
    study.surfaces[0].areas_mm2 = study.surfaces[0].geometry->vertex_areas_mm2();
    const std::array looked{static_cast<const StudyFixation*>(&study.results.fixations[0])};
    {
        const SurfaceDistances distances(study.results, 0, study.surfaces[0]);
        CHECK(distances.covered(looked, 10.0) == Approx(1.0));
        CHECK(distances.covered({}, 10.0) == 0.0);
        // A quarter of the way round is half of the ball.
        CHECK(distances.covered(looked, 0.5 * 3.14159265) == Approx(0.5).margin(0.06));
    }
    StudyObject& ball = study.results.objects[0];
    for (std::size_t v = 0; v < ball.seconds_visible.size(); ++v)
        ball.seconds_visible[v] = ball.mesh->positions[v].y < 0.0f ? 1.0f : 0.0f;
    CHECK(SurfaceDistances(study.results, 0, study.surfaces[0]).covered(looked, 0.5 * 3.14159265) ==
          Approx(1.0).margin(0.1));
    ball.seconds_visible.assign(ball.seconds_visible.size(), 0.0f);
    CHECK(SurfaceDistances(study.results, 0, study.surfaces[0]).covered(looked, 10.0) == 0.0);
}

TEST_CASE("only maps of different observers in one cell and on one object are compared", "[unit]") {
    const std::vector<double> areas{1.0, 1.0, 2.0}, left{1.0, 0.0, 0.0}, right{0.0, 1.0, 0.0},
        even{1.0, 1.0, 1.0};
    // Two observers whose maps of a level are the same, and those of two levels have nothing in common.
    std::vector<LikeMaps> maps;
    for (const std::size_t observer : {0u, 1u, 2u})
        maps.push_back({observer, 0, 0, left, right, areas});
    const auto found = observer_similarities(maps, 3, 0.95);
    const double apart = -1.0 / 3.0; // r of two maps that are 1 on a quarter of the area each
    CHECK(*found[0].same_level.value == Approx(1.0));
    CHECK(*found[0].other_level.value == Approx(apart));
    CHECK(*found[0].difference.value == Approx(1.0 - apart));
    CHECK(*found[1].same_level.value == Approx(1.0));
    CHECK(*found[1].other_level.value == Approx(0.0).margin(1e-12));
    // Maps of other cells, other objects and of one observer make no pair with these.
    maps.push_back({3, 1, 0, even, left, areas});
    maps.push_back({4, 0, 1, even, left, areas});
    maps.push_back({4, 0, 1, left, even, areas});
    const auto again = observer_similarities(maps, 5, 0.95);
    for (std::size_t which = 0; which < found.size(); ++which) {
        CHECK(*again[which].same_level.value == *found[which].same_level.value);
        CHECK(*again[which].other_level.value == *found[which].other_level.value);
    }
    CHECK_FALSE(observer_similarities(std::span(maps).first(1), 5, 0.95)[0].same_level.value);
    CHECK(least_similarity(0) == -1.0);
    CHECK(least_similarity(1) == 0.0);
    const Estimate cut = within(Estimate::of(0.5, Interval{-2.0, 3.0}), -1.0);
    CHECK(cut.interval->low == -1.0);
    CHECK(cut.interval->high == 1.0);
}
