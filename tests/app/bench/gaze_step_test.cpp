/// A step that waits for gaze on an area of a moving object ends by the very sample that was planted.
#include <catch2/catch.hpp>

#include "app/bench/gaze_step_simulation.h"
#include "tests/support/figures.h"

using namespace overt;

TEST_CASE("gaze on a moving area ends its step by the planted sample, live and from the record", "[unit]") {
    Protocol protocol;
    protocol.display.latency_ms = 3.5;
    ObjectSettings settings;
    settings.id = "bust";
    protocol.objects = {settings};
    std::vector<Object> objects(1);
    objects[0].id = "bust";
    // The head stands off the axis: which part is seen at a place depends on the frame that is lit.
    Mesh mesh;
    test::add_part(mesh, test::box({-70.0, -45.0, 40.0}, {70.0, 45.0, 190.0}), "body");
    test::add_part(mesh, test::ball({60.0, -30.0, 245.0}, 52.0), "head");
    const View view{fit_camera(mesh, {11.9}, {1024, 1024}, {25.0}, 0.06), {1024, 1024}};
    objects[0].scenes = {{view, mesh.bounds()}};
    objects[0].mesh = std::move(mesh);
    for (const std::uint64_t seed : {1u, 2u}) {
        const GazeStepTrials found = simulate_gaze_steps(protocol, objects, "head", 20, seed);
        CHECK(found.trials == 20);
        CHECK(found.at_planted_sample == 20);
        CHECK(found.again_from_record == 20);
        CHECK(found.at_next_flip == 20);
        CHECK(found.on_area > found.samples / 20);
        CHECK(found.on_area < found.samples / 2);
    }
}
