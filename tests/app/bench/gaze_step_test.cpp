/// A step that waits for gaze on an area of a moving object ends by the very sample that was planted.
#include <catch2/catch.hpp>

#include "app/bench/gaze_step_simulation.h"
#include "tests/support/figures.h"

using namespace overt;

namespace {

/// A bust, as each view of the protocol sees it at each size of slots. Its head stands off the axis: which
/// part is seen at a place depends on the frame that is lit.
std::vector<Object> busts(const Protocol& protocol) {
    Mesh mesh;
    test::add_part(mesh, test::box({-70.0, -45.0, 40.0}, {70.0, 45.0, 190.0}), "body");
    test::add_part(mesh, test::ball({60.0, -30.0, 245.0}, 52.0), "head");
    std::vector<Object> objects(1);
    objects[0].id = "bust";
    for (std::size_t i = 0; i < protocol.views_at_all_sizes(); ++i) {
        const ViewSettings& view = protocol.view_at(static_cast<int>(i));
        const glm::ivec2 size_px(view.width_px, view.height_px);
        objects[0].scenes.push_back(
            {{fit_camera(mesh, {11.9}, size_px, {25.0}, 0.06), size_px}, mesh.bounds()});
    }
    objects[0].mesh = std::move(mesh);
    return objects;
}

} // namespace

TEST_CASE("gaze on a moving area ends its step by the planted sample, live and from the record", "[unit]") {
    Protocol protocol;
    protocol.display.latency_ms = 3.5;
    ObjectSettings settings;
    settings.id = "bust";
    protocol.objects = {settings};
    const std::vector<Object> objects = busts(protocol);
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

TEST_CASE("gaze on an area of what moves in the second slot ends the step, and gaze on the first does not",
          "[unit]") {
    Protocol protocol;
    protocol.display.latency_ms = 3.5;
    ObjectSettings settings;
    settings.id = "bust";
    protocol.objects = {settings};
    // The second is smaller, and what is in it turns the other way round.
    protocol.slot_entries.resize(2);
    SlotSettings &left = protocol.slot_entries[0], &right = protocol.slot_entries[1];
    left.id = "left";
    left.right_deg = -5.5;
    left.size_deg = 10.0;
    right.id = "right";
    right.right_deg = 5.5;
    right.up_deg = 1.0;
    right.size_deg = 6.0;
    protocol.slots = written_out(protocol.slot_entries);
    fit_views_to_slots(protocol);
    REQUIRE(protocol.slots[1].size == 1);
    protocol.motions.resize(2);
    protocol.motions[1].amplitude = {-20.0};
    const std::vector<Object> objects = busts(protocol);
    Stimulus turned;
    turned.motion = 1;
    for (const std::size_t awaited : {0u, 1u}) {
        const GazeStepScene scene{{{{}, 0}, {turned, 1}}, awaited};
        const GazeStepTrials found = simulate_gaze_steps(protocol, objects, "head", 20, 3, scene);
        CHECK(found.at_planted_sample == 20);
        CHECK(found.again_from_record == 20);
        CHECK(found.at_next_flip == 20);
        CHECK(found.on_area > found.samples / 20);
    }
}
