#include <array>
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "devices/simulated/gaze_targets.h"
#include "devices/simulated/observed_scene.h"
#include "devices/simulated/simulated_eye_tracker.h"
#include "tests/support/figures.h"

using namespace overt;
using namespace std::chrono_literals;

TEST_CASE("simulated devices take their numbers from the protocol", "[unit]") {
    Protocol protocol;
    protocol.display.latency_ms = 3.5;
    protocol.display.refresh_hz = 240.0;
    protocol.tasks = {{"age", "How old?", TaskCoverage::once_per_object, 0.61, {}}};
    protocol.tracker.rate_hz = 500.0;
    protocol.tracker.eye = "left";
    protocol.tracker.simulated_noise_deg = 0.01;
    std::vector<Object> objects(2);
    objects[0].mesh = test::bust();
    for (Object& object : objects)
        object.scenes.resize(1);

    const ObservedScene scene = make_observed_scene(protocol, objects, ScreenGeometry{});
    CHECK(scene.objects[0].mesh == &*objects[0].mesh);
    CHECK(scene.objects[1].mesh == nullptr);
    CHECK(scene.tasks[0].id == "age");
    CHECK(scene.tasks[0].shares == std::vector<double>{0.61});
    CHECK(scene.display_latency == 3500us);
    CHECK(scene.refresh_hz == 240.0);
    CHECK(scene.effects.empty());

    const SimulatedTrackerSettings tracker = simulated_tracker_settings(protocol.tracker);
    CHECK(tracker.rate_hz == 500.0);
    CHECK(tracker.eye == Eye::left);
    CHECK(tracker.noise_deg == 0.01);
    CHECK(tracker.accuracy_deg == protocol.tracker.simulated_accuracy_deg);
    CHECK(tracker.clock_drift_ppm == protocol.tracker.simulated_clock_drift_ppm);
    CHECK_FALSE(tracker.both_eyes);
    protocol.tracker.eye = "both";
    CHECK(simulated_tracker_settings(protocol.tracker).both_eyes);
    protocol.tracker.simulated_clock_drift_ppm = 77.0;
    protocol.tracker.simulated_accuracy_deg = 0.77;
    CHECK(simulated_tracker_settings(protocol.tracker).clock_drift_ppm == 77.0);
    CHECK(simulated_tracker_settings(protocol.tracker).accuracy_deg == 0.77);
}

TEST_CASE("simulated effects come from the protocol by number", "[unit]") {
    Protocol protocol;
    protocol.tasks = {{"free", "Look."}, {"age", "How old?"}};
    protocol.materials.resize(3);
    protocol.materials[2].id = "gold";
    protocol.objects.resize(2);
    protocol.objects[1].id = "runner";
    protocol.simulated_effects.resize(2);
    protocol.simulated_effects[0].task = "age";
    protocol.simulated_effects[0].entries = {"runner", "gold"};
    protocol.simulated_effects[0].head_odds = 2.0;
    protocol.simulated_effects[0].spot_share = 0.25;
    protocol.simulated_effects[1].entries = {"", "gold"};
    protocol.simulated_observers.head_share_sd = 0.5;
    const ObservedScene scene = make_observed_scene(protocol, {}, ScreenGeometry{});
    REQUIRE(scene.effects.size() == 2);
    CHECK(scene.effects[0].task == 1);
    CHECK(scene.effects[0].holds_in(1, {1, 2}));
    CHECK_FALSE(scene.effects[0].holds_in(1, {0, 2}));
    CHECK_FALSE(scene.effects[0].holds_in(1, {1, 0}));
    CHECK(scene.effects[0].odds == 2.0);
    CHECK(scene.effects[0].spot_share == 0.25);
    CHECK(scene.effects[1].task == -1);
    CHECK(scene.effects[1].holds_in(0, {0, 2}));
    CHECK_FALSE(scene.effects[1].holds_in(0, {0, 1}));
    CHECK(scene.share_sd == 0.5);
}

TEST_CASE("a row's light comes after the vertical blank by the latency and its share of the scan", "[unit]") {
    ObservedScene scene;
    scene.display_latency = 2ms;
    CHECK(scene.light_delay(-5.0) == 2ms);
    CHECK(to_seconds(scene.light_delay(540.0)) == Approx(0.002 + 0.5 / 120.0));
    CHECK(scene.light_delay(2000.0) == scene.light_delay(1080.0));
    CHECK(to_seconds(scene.frame_period(0)) == Approx(1.0 / 30.0));
    scene.refresh_hz = 100.0; // no whole number of refreshes
    CHECK(to_seconds(scene.frame_period(0)) == Approx(1.0 / 30.0));
    scene.refresh_hz = 119.88; // four refreshes to a frame all the same
    CHECK(to_seconds(scene.frame_period(0)) == Approx(4.0 / 119.88));
}

TEST_CASE("slots of another size see the views of their size, and steps that show for longer are told",
          "[unit]") {
    Protocol protocol;
    protocol.tasks = {{"free", "Look."}};
    protocol.views.resize(2);
    protocol.slot_entries.resize(2);
    protocol.slots.resize(2);
    protocol.slots[1].size = 1;
    StepSettings step;
    step.kind = StepKind::show;
    step.ends_by_answer = true;
    protocol.tasks[0].steps = {step};
    protocol.screens.response_max_s = 33.0;
    ObservedScene scene = make_observed_scene(protocol, {}, ScreenGeometry{});
    CHECK(scene.slots.size() == 2);
    CHECK(scene.slot_views == std::vector<int>{0, 2});
    CHECK(scene.longest_step_s == 33.0);
    CHECK(scene.longest_s() == 33.0);
    scene.views = 4;
    Stimulus stimulus;
    stimulus.object = 3;
    stimulus.view = 1;
    CHECK(scene.index_of({stimulus, 0}) == 13);
    CHECK(scene.index_of({stimulus, 1}) == 15);
    protocol.tasks[0].steps[0].kind = StepKind::blank;
    CHECK(make_observed_scene(protocol, {}, ScreenGeometry{}).longest_step_s == 0.0);
    protocol.slot_entries.clear();
    CHECK(make_observed_scene(protocol, {}, ScreenGeometry{}).slots.empty());
    CHECK(px_per_deg_at_centre(scene.screen).x ==
          Approx(std::tan(std::numbers::pi / 180.0) * scene.screen.viewing_distance_mm *
                 scene.screen.screen_px.x / scene.screen.screen_mm.x));
}

TEST_CASE("an effect on a task or an area that there is not is on none of them, and on the first", "[unit]") {
    Protocol protocol;
    protocol.tasks = {{"free", "Look."}, {"age", "How old?"}};
    protocol.simulated_effects.resize(4);
    protocol.simulated_effects[0].task = "age";
    protocol.simulated_effects[1].task = "free";
    protocol.simulated_effects[2].task = "unknown";
    protocol.simulated_effects[3].area = "unknown";
    protocol.simulated_effects[3].area_odds = 5.0;
    protocol.simulated_effects[3].head_odds = 7.0;
    const ObservedScene scene = make_observed_scene(protocol, {}, ScreenGeometry{});
    CHECK(scene.effects[0].task == 1);
    CHECK(scene.effects[1].task == 0);
    CHECK(scene.effects[2].task == -1);
    CHECK(scene.effects[3].task == -1);
    CHECK(scene.effects[3].area == 0);
    CHECK(scene.effects[3].odds == 5.0);
    protocol.tasks.emplace_back(); // one without an id is nobody's task
    CHECK(make_observed_scene(protocol, {}, ScreenGeometry{}).effects[3].task == -1);
}

TEST_CASE("the surface at a place of the image lies where its depth and its incidence say", "[unit]") {
    const Mesh mesh = test::bust();
    const View view{fit_camera(mesh, {11.9}, {256, 256}, {25.0}, 0.06), {256, 256}};
    ObservedScene scene;
    scene.objects = {{&mesh, SceneView{view, mesh.bounds()}}};
    const GazeTargets targets(scene.objects[0], scene);
    int seen = 0;
    for (const double degrees : {0.0, 20.0})
        for (int y = 40; y < 256; y += 24)
            for (int x = 40; x < 256; x += 24) {
                const ObjectPose pose = scene.animations[0].object_in({degrees == 0.0 ? 0 : 20});
                const glm::dvec2 place(x + 0.5, y + 0.25);
                const auto point = targets.surface_at(place, pose);
                if (!point)
                    continue;
                ++seen;
                const glm::dmat4 to_world = targets.world_from_object(pose);
                const glm::dvec3 at(to_world * glm::dvec4(point->position, 1.0));
                CHECK(point->depth == Approx(view.depth_of(at)));
                const glm::dvec2 back = targets.project(point->position, to_world);
                CHECK(back.x == Approx(place.x).margin(1e-6));
                CHECK(back.y == Approx(place.y).margin(1e-6));
                CHECK(point->barycentric.x + point->barycentric.y + point->barycentric.z == Approx(1.0));
                CHECK(point->part == mesh.triangle_parts[point->triangle]);
                // Between the ray and the normal of the triangle.
                const glm::uvec3 corners = mesh.triangles[point->triangle];
                const glm::dvec3 a(mesh.positions[corners.x]), b(mesh.positions[corners.y]),
                    c(mesh.positions[corners.z]);
                const glm::dvec3 normal(to_world * glm::dvec4(glm::cross(b - a, c - a), 0.0));
                const glm::dvec3 ray = at - view.camera.position;
                const double cosine =
                    std::abs(glm::dot(normal, ray)) / (glm::length(normal) * glm::length(ray));
                CHECK(std::cos(to_radians(point->incidence).value) == Approx(cosine).margin(1e-9));
            }
    CHECK(seen > 30);
    CHECK_FALSE(targets.surface_at({1.0, 1.0}, scene.animations[0].object_in({0})));
}

TEST_CASE("effects are on the areas that they name, and those on heads on the first", "[unit]") {
    Protocol protocol;
    protocol.tasks = {{"free", "Look."}};
    protocol.tasks[0].simulated_area_shares = {{"rim", 0.2}, {"foot", 0.1}};
    protocol.simulated_effects.resize(4);
    protocol.simulated_effects[0].area = "rim";
    protocol.simulated_effects[0].area_odds = 5.0;
    protocol.simulated_effects[0].head_odds = 7.0;
    protocol.simulated_effects[1].area = "foot";
    protocol.simulated_effects[2].area = "head";
    protocol.simulated_effects[3].head_odds = 3.0;
    const ObservedScene scene = make_observed_scene(protocol, {}, ScreenGeometry{});
    CHECK(scene.areas == std::vector<std::string>{"head", "rim", "foot"});
    CHECK(scene.tasks[0].shares == std::vector<double>{0.0, 0.2, 0.1});
    CHECK(scene.effects[0].area == 1);
    CHECK(scene.effects[0].odds == 5.0);
    CHECK(scene.effects[1].area == 2);
    CHECK(scene.effects[2].area == 0);
    CHECK(scene.effects[3].area == 0);
    CHECK(scene.effects[3].odds == 3.0);
    CHECK(area_in(scene, "rim") == 1);
    CHECK(area_in(scene, "nose") == -1);
}

TEST_CASE("the longest show is that of a step with its own time, of an answer's, or of a motion", "[unit]") {
    Protocol protocol;
    protocol.tasks = {{"free", "Look."}};
    protocol.screens.response_max_s = 33.0;
    StepSettings timed, answered, plain;
    for (StepSettings* step : {&timed, &answered, &plain})
        step->kind = StepKind::show;
    timed.duration = StepDuration{.choices_s = {50.0, 20.0}};
    answered.ends_by_answer = true;
    const auto longest_s = [&](std::vector<StepSettings> steps) {
        protocol.tasks[0].steps = std::move(steps);
        return make_observed_scene(protocol, {}, ScreenGeometry{}).longest_step_s;
    };
    CHECK(longest_s({plain}) == 0.0);
    CHECK(longest_s({timed}) == 50.0);
    CHECK(longest_s({answered}) == 33.0);
    CHECK(longest_s({timed, answered}) == 50.0);
    CHECK(longest_s({answered, timed}) == 50.0);
    timed.ends_by_answer = true;
    CHECK(longest_s({timed}) == 50.0);
}

namespace {

/// Triangles of half a square millimetre in a row along x, each a part of its own name, seen from above.
Mesh row_of_triangles(const std::vector<std::string>& parts, double from_x) {
    Mesh mesh;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const auto x = static_cast<float>(from_x + 2.0 * static_cast<double>(i));
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.insert(mesh.positions.end(),
                              {{x, 0.0f, 0.0f}, {x + 1.0f, 0.0f, 0.0f}, {x, 0.0f, 1.0f}});
        mesh.triangles.emplace_back(first, first + 1, first + 2);
        mesh.triangle_parts.push_back(static_cast<PartIndex>(i));
    }
    mesh.part_names = parts;
    return mesh;
}

ObservedScene scene_of_areas(const Mesh& mesh, std::vector<std::string> areas) {
    ObservedScene scene;
    const View view{fit_camera(mesh, {11.9}, {256, 256}, {25.0}, 0.06), {256, 256}};
    scene.objects = {{&mesh, SceneView{view, mesh.bounds()}}};
    scene.areas = std::move(areas);
    return scene;
}

/// How many numbers of a stream were taken for a draw.
int taken_for(const GazeTargets& targets, double spread) {
    RandomStream drawn(3, "draws"), counted(3, "draws");
    targets.draw(drawn, targets.elsewhere(), spread);
    const double next = drawn.uniform();
    int count = 0;
    while (counted.uniform() != next)
        ++count;
    return count;
}

} // namespace

TEST_CASE("a region that an object lacks is looked for elsewhere, and then in the first that it has",
          "[unit]") {
    RandomStream random(1, "regions");
    const Mesh with_rest = row_of_triangles({"rim", "rest"}, 0.0);
    const ObservedScene partly = scene_of_areas(with_rest, {"head", "rim"});
    const GazeTargets some(partly.objects[0], partly);
    CHECK(some.elsewhere() == 2);
    CHECK(some.draw(random, 0).part == 1); // elsewhere
    CHECK(some.draw(random, 1).part == 0);
    CHECK(some.draw(random, 2).part == 1);
    const Mesh without = row_of_triangles({"rim", "foot"}, 0.0);
    const ObservedScene scene = scene_of_areas(without, {"head", "rim", "foot"});
    const GazeTargets others(scene.objects[0], scene);
    CHECK(others.draw(random, 0).part == 0);
    CHECK(others.draw(random, 1).part == 0);
    CHECK(others.draw(random, 2).part == 1);
    CHECK(others.draw(random, 3).part == 0);
}

TEST_CASE("plinths are looked at a tenth as often as their area says", "[unit]") {
    const Mesh mesh = row_of_triangles({"plinth", "body", "base"}, 0.0);
    const ObservedScene scene = scene_of_areas(mesh, {"head"});
    const GazeTargets targets(scene.objects[0], scene);
    RandomStream random(1, "plinths");
    std::array<int, 3> often{};
    for (int i = 0; i < 21'000; ++i)
        ++often[targets.draw(random, targets.elsewhere()).part];
    CHECK(std::abs(often[0] - 1000) < 130); // four standard deviations
    CHECK(std::abs(often[1] - 10'000) < 300);
}

TEST_CASE("a spread is taken by distances of the object itself, however small and far away, in 500 tries",
          "[unit]") {
    const Mesh row = row_of_triangles({"a", "b", "c", "d", "e"}, 1000.0);
    Mesh tiny = row; // of less than a square millimetre
    for (glm::vec3& at : tiny.positions)
        at *= 0.1f;
    for (const Mesh* const mesh : {&row, static_cast<const Mesh*>(&tiny)}) {
        const ObservedScene scene = scene_of_areas(*mesh, {"head"});
        const GazeTargets targets(scene.objects[0], scene);
        std::array<int, 5> inward{}, outward{};
        RandomStream random(1, "spreads");
        for (int i = 0; i < 2000; ++i) {
            ++inward[targets.draw(random, 1, -3.0).part];
            ++outward[targets.draw(random, 1, 3.0).part];
        }
        // Of five in a row the outer ones lie at twice the mean square distance, their neighbours at half.
        CHECK(inward[2] > 1280);
        CHECK(inward[0] + inward[4] < 30);
        CHECK(outward[0] + outward[4] > 1800);
        CHECK(outward[2] < 40);
        CHECK(std::abs(inward[1] - inward[3]) < 130);
        // A point takes three numbers, and whether it is taken one.
        CHECK(taken_for(targets, 0.0) == 3);
        CHECK(taken_for(targets, -1e-12) == 4);
        CHECK(taken_for(targets, -1e12) == 3 + 500 * 4); // none is taken
    }
    // One triangle lies in its own middle: each place of it is taken at once.
    const Mesh one = row_of_triangles({"a"}, 1000.0);
    const ObservedScene scene = scene_of_areas(one, {"head"});
    CHECK(taken_for(GazeTargets(scene.objects[0], scene), -1e-12) == 4);
}

TEST_CASE("what is seen at less than 78 degrees from its normal is looked at, from either side", "[unit]") {
    const Mesh mesh = row_of_triangles({"a"}, 0.0);
    ObservedScene scene = scene_of_areas(mesh, {"head"});
    RandomStream random(1, "oblique");
    for (const double aslant_deg : {0.0, 60.0, 77.0, 79.0, 100.0, 103.0, 180.0}) {
        CAPTURE(aslant_deg);
        const double aslant = aslant_deg * std::numbers::pi / 180.0;
        // The camera goes round with the object as it stands in the first frame.
        const ObjectPose pose = scene.animations[0].object_in(scene.animations[0].frame_at_step(0));
        scene.objects[0].scene.view.camera.position =
            glm::dvec3(GazeTargets(scene.objects[0], scene).world_from_object(pose) *
                       glm::dvec4(0.5 + 1e5 * std::sin(aslant), -1e5 * std::cos(aslant), 0.5, 1.0));
        const GazeTargets targets(scene.objects[0], scene);
        CHECK(targets.is_visible(targets.draw(random, 1), 0, 0) == (aslant_deg < 78.0 || aslant_deg > 102.0));
    }
}

TEST_CASE("each task has its own shares of all areas that any task names", "[unit]") {
    Protocol protocol;
    protocol.tasks = {{"free", "Look."}, {"rims", "Look at rims."}, {"feet", "Look at feet."}};
    protocol.tasks[0].simulated_area_shares = {{"body", 0.4}};
    protocol.tasks[1].simulated_area_shares = {{"rim", 0.3}, {"body", 0.25}};
    protocol.tasks[2].simulated_area_shares = {{"foot", 0.5}};
    const ObservedScene scene = make_observed_scene(protocol, {}, ScreenGeometry{});
    REQUIRE(scene.tasks.size() == 3);
    for (const auto& [task, shares] : {std::pair{0, std::array{0.4, 0.0, 0.0}},
                                       {1, std::array{0.25, 0.3, 0.0}},
                                       {2, std::array{0.0, 0.0, 0.5}}}) {
        double all = 0.0;
        for (const double share : scene.tasks[static_cast<std::size_t>(task)].shares)
            all += share;
        CHECK(all == Approx(shares[0] + shares[1] + shares[2]));
        for (std::size_t i = 0; i < 3; ++i) {
            const int area = area_in(scene, std::array{"body", "rim", "foot"}[i]);
            REQUIRE(area >= 0);
            CHECK(scene.tasks[static_cast<std::size_t>(task)].shares[static_cast<std::size_t>(area)] ==
                  shares[i]);
        }
    }
}

TEST_CASE("motions are those of the protocol, and a frame is lit for whole refreshes, or as long as it asks",
          "[unit]") {
    Protocol protocol;
    protocol.tasks = {{"free", "Look."}};
    protocol.display.refresh_hz = 120.0;
    protocol.motions.resize(3);
    protocol.motions[1].duration_s = 7.5;
    protocol.motions[0].frame_rate_hz = 120.0;
    protocol.motions[1].frame_rate_hz = 30.0;
    protocol.motions[2].frame_rate_hz = 300.0; // no whole refresh has it
    const ObservedScene scene = make_observed_scene(protocol, {}, ScreenGeometry{});
    REQUIRE(scene.animations.size() == 3);
    CHECK(scene.animations[1].duration_s == 7.5);
    CHECK(to_seconds(scene.frame_period(0)) == Approx(1.0 / 120.0));
    CHECK(to_seconds(scene.frame_period(1)) == Approx(1.0 / 30.0));
    CHECK(to_seconds(scene.frame_period(2)) == Approx(1.0 / 300.0));
}
