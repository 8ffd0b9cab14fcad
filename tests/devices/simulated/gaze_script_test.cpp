#include "devices/simulated/gaze_script.h"

#include <cmath>

#include <catch2/catch.hpp>

#include "tests/devices/simulated/sitting.h"

using namespace overt;

TEST_CASE("a region that is small against saccades gets the fixations that are planned for it", "[unit]") {
    const Mesh mesh = test::bust();
    const ObservedScene scene = test::scene_with(mesh);
    const GazeTargets targets(scene.objects[0], scene);
    const PursuedTurn turn(scene);
    GazePlan plan;
    plan.shares[0] = 0.6;
    plan.area_count = 1;
    // The head is 5 degrees wide: few of its places are 4 degrees from another.
    for (const double shortest_deg : {0.75, 4.0}) {
        CAPTURE(shortest_deg);
        const ObserverSettings settings{.shortest_saccade = Degrees{shortest_deg}};
        GazeScript script(scene, settings);
        int heads = 0, all = 0, near = 0;
        for (int trial = 0; trial < 100; ++trial) {
            script.compose(scene, &targets, turn, settings, 3, trial, plan);
            const auto& fixations = script.fixations();
            for (std::size_t i = 1; i < fixations.size(); ++i) {
                REQUIRE(fixations[i].target);
                heads += mesh.part_names[fixations[i].target->part] == "head";
                ++all;
                const auto place = [&](const ScriptedFixation& of) {
                    return place_of(of, fixations[i - 1].end, scene, &targets, turn);
                };
                const Degrees way = scene.screen.angle_between(place(fixations[i - 1]), place(fixations[i]));
                near += way.value < shortest_deg;
            }
        }
        // 3.29 standard errors: chance goes beyond once in a thousand.
        CHECK(std::abs(heads - 0.6 * all) < 3.29 * std::sqrt(0.6 * 0.4 * all));
        if (shortest_deg < 1.0)
            CHECK(near == 0);
        else
            CHECK(near > 0);
    }
}

TEST_CASE(
    "the first saccade comes 0.12 to 0.4 s after the onset, and pictures are looked at about their middle",
    "[unit]") {
    ObservedScene scene;
    scene.animations[0].duration_s = 0.2;
    scene.screen.image_px = {400, 300};
    const PursuedTurn turn(scene);
    GazeScript script(scene, {});
    double earliest_s = 1.0, latest_s = 0.0;
    glm::dvec2 low(1e9), high(-1e9), sum(0.0), squares(0.0);
    int count = 0;
    for (int trial = 0; trial < 20'000; ++trial) {
        script.compose(scene, nullptr, turn, {}, 7, trial, {});
        const std::vector<ScriptedFixation>& fixations = script.fixations();
        const double first_s = to_seconds(fixations.front().end);
        earliest_s = std::min(earliest_s, first_s);
        latest_s = std::max(latest_s, first_s);
        for (std::size_t i = 1; i < fixations.size(); ++i, ++count) {
            const glm::dvec2 place = scene.screen.image_from_screen(fixations[i].place);
            low = glm::min(low, place);
            high = glm::max(high, place);
            const glm::dvec2 share = place / glm::dvec2(400.0, 300.0) - 0.5;
            sum += share;
            squares += share * share;
        }
        // It goes on for two seconds after the planned end.
        REQUIRE(fixations.back().end >= from_seconds(2.2));
        REQUIRE(fixations[fixations.size() - 2].end < from_seconds(2.2));
    }
    CHECK(earliest_s >= 0.12);
    CHECK(earliest_s < 0.121);
    CHECK(latest_s <= 0.4);
    CHECK(latest_s > 0.385);
    for (int axis = 0; axis < 2; ++axis) {
        CHECK(std::abs(sum[axis] / count) < 0.002);
        CHECK(std::sqrt(squares[axis] / count) == Approx(0.15).epsilon(0.015));
        CHECK(low[axis] == Approx(0.0).margin(1e-9));
        CHECK(high[axis] == Approx(axis == 0 ? 399.0 : 299.0));
    }
}

TEST_CASE("a time belongs to the fixation that has begun last, and shows have scripts of their own",
          "[unit]") {
    ObservedScene scene;
    const PursuedTurn turn(scene);
    GazeScript script(scene, {});
    script.compose(scene, nullptr, turn, {}, 7, 0, {});
    const SessionDuration second = script.fixations()[1].begin, third = script.fixations()[2].begin;
    CHECK(script.fixation_at(SessionDuration(-1)) == 0);
    CHECK(script.fixation_at({}) == 0);
    CHECK(script.fixation_at(second - SessionDuration(1)) == 0);
    CHECK(script.fixation_at(second) == 1);
    CHECK(script.fixation_at(third - SessionDuration(1)) == 1);
    CHECK(script.fixation_at(third) == 2);
    CHECK(script.fixation_at(script.fixations().back().end * 2) == script.fixations().size() - 1);
    CHECK(script_number(7, 0) == 7);
    CHECK(script_number(7, 1) == 7 + 1'048'576);
    CHECK(script_number(0, 3) == 3 * 1'048'576);
}

TEST_CASE("where few places are far enough, two hundred are drawn, and what is taken stays what it was",
          "[unit]") {
    const Mesh mesh = test::bust();
    const ObservedScene scene = test::scene_with(mesh);
    const GazeTargets targets(scene.objects[0], scene);
    const PursuedTurn turn(scene);
    GazePlan plan;
    plan.shares[0] = 0.9;
    plan.area_count = 1;
    const ObserverSettings settings{.shortest_saccade = Degrees{6.0}};
    GazeScript script(scene, settings);
    glm::dvec3 sum(0.0);
    for (int trial = 0; trial < 4; ++trial) {
        script.compose(scene, &targets, turn, settings, 3, trial, plan);
        double weight = 1.0;
        for (const ScriptedFixation& fixation : script.fixations())
            if (fixation.target)
                sum += (weight += 0.01) * fixation.target->position;
    }
    CAPTURE(sum.x, sum.y, sum.z);
    CHECK(sum.x == Approx(-97.5825905493).epsilon(1e-6));
    CHECK(sum.y == Approx(-4490.0214454771).epsilon(1e-6));
    CHECK(sum.z == Approx(34543.6936662335).epsilon(1e-6));
}
