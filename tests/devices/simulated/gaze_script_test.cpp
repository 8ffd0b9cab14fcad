#include "devices/simulated/gaze_script.h"

#include <cmath>

#include <catch2/catch.hpp>

#include "tests/devices/simulated/sitting.h"

using namespace overt;
using namespace std::chrono_literals;

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

TEST_CASE("an eye pursues a turn from its first step to its last, and stays at both ends", "[unit]") {
    ObservedScene scene;
    scene.refresh_hz = 120.0;
    Animation& motion = scene.animations[0];
    motion.duration_s = 2.0;
    const PursuedTurn turn(scene);
    const SessionDuration period = scene.frame_period(0);
    const int steps = motion.shown_frame_count();
    REQUIRE(steps > 3);
    const auto half = [&](int step) { return step * period + period / 2; };
    CHECK(turn.step_at(-1s) == 0);
    CHECK(turn.step_at(0s) == 0);
    CHECK(turn.step_at(period - 1ns) == 0);
    CHECK(turn.step_at(period) == 1);
    CHECK(turn.step_at(steps * period) == steps - 1);
    CHECK(turn.step_at(steps * period + 1s) == steps - 1);
    const auto yaw = [&](SessionDuration at) { return turn.angle_at(at).angle.value; };
    const double first = turn.angle_of_step(0).angle.value, second = turn.angle_of_step(1).angle.value,
                 last = turn.angle_of_step(steps - 1).angle.value;
    REQUIRE(first != second);
    CHECK(yaw(-1s) == first);
    CHECK(yaw(half(0)) == Approx(first).margin(1e-4));
    CHECK(yaw(period) == Approx(0.5 * (first + second)).margin(1e-4));
    CHECK(yaw(half(1)) == Approx(second).margin(1e-4));
    CHECK(yaw(half(steps - 1)) == Approx(last).margin(1e-4));
    CHECK(yaw(half(steps - 1) + 10s) == last);
    CHECK(turn.motion() == 0);
}

TEST_CASE("what the observer turns stands as its motion says until it is seen, and a turn knows its motion",
          "[unit]") {
    ObservedScene scene;
    scene.animations.resize(3);
    scene.animations[1].kind = MotionKind::observer;
    scene.animations[1].angle = Degrees{40.0};
    scene.animations[2].duration_s = 0.5;
    const std::vector<PursuedTurn> turns = turns_of(scene);
    REQUIRE(turns.size() == 3);
    for (int motion = 0; motion < 3; ++motion)
        CHECK(turns[static_cast<std::size_t>(motion)].motion() == motion);
    const int nearest = scene.animations[1].by_observer.nearest(scene.animations[1].angle);
    REQUIRE(nearest > 1);
    for (const SessionDuration at : {-1s, 0s, 5s}) {
        CHECK(turns[1].step_at(at) == nearest);
        CHECK(turns[1].angle_at(at).angle.value == turns[1].angle_of_step(nearest).angle.value);
    }
}

TEST_CASE("a region of which nothing can be seen leaves its fixations to what can", "[unit]") {
    // Two squares of one size, the second one behind the first.
    Mesh mesh;
    for (const float y : {0.0f, 1.0f}) {
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        const float half = y == 0.0f ? 60.0f : 20.0f;
        for (const auto& [x, z] : {std::pair{-1.0f, -1.0f}, {1.0f, -1.0f}, {1.0f, 1.0f}, {-1.0f, 1.0f}})
            mesh.positions.emplace_back(half * x, 30.0f * y, half * z);
        mesh.triangles.emplace_back(first, first + 1, first + 2);
        mesh.triangles.emplace_back(first, first + 2, first + 3);
        mesh.triangle_parts.insert(mesh.triangle_parts.end(), 2, y == 0.0f ? PartIndex{0} : PartIndex{1});
    }
    mesh.part_names = {"front", "back"};
    ObservedScene scene = test::scene_with(mesh);
    scene.animations[0].kind = MotionKind::still;
    for (const bool named : {true, false}) {
        CAPTURE(named);
        scene.areas = {named ? "back" : "front"};
        scene.tasks = {{"free", {named ? 1.0 : 0.0}}};
        const GazeTargets targets(scene.objects[0], scene);
        const PursuedTurn turn(scene);
        GazePlan plan;
        plan.area_count = 1;
        plan.shares[0] = named ? 1.0 : 0.0;
        GazeScript script(scene, {});
        script.compose(scene, &targets, turn, {}, 3, 0, plan);
        REQUIRE(script.fixations().size() > 5);
        for (std::size_t i = 1; i < script.fixations().size(); ++i) {
            REQUIRE(script.fixations()[i].target);
            CHECK(script.fixations()[i].target->part == 0);
        }
    }
}
