#include "experiment/animation.h"

#include <bit>
#include <cmath>

#include <catch2/catch.hpp>

#include "experiment/base/error.h"

using namespace overt;

namespace {

std::uint64_t bits(Degrees angle) { return std::bit_cast<std::uint64_t>(angle.value); }

} // namespace

TEST_CASE("the 61 frames of a cycle go through 31 distinct poses", "[unit]") {
    const PoseTable poses = distinct_poses(Animation{});
    CHECK(poses.frames_of(0).size() == 61);
    CHECK(poses.angles.size() == 31);
}

TEST_CASE("a cycle follows the sine, and its second half mirrors the first to the bit", "[unit]") {
    const Animation animation;
    for (int k = 0; k <= 60; ++k) {
        const double expected = 25.0 * std::sin(2.0 * std::numbers::pi * k / 60.0);
        CHECK(animation.angle_of({k}).value == Approx(expected).margin(1e-13));
        CHECK(animation.angle_of({k}).value == -animation.angle_of({60 - k}).value);
        if (k <= 30)
            CHECK(bits(animation.angle_of({k})) == bits(animation.angle_of({30 - k})));
    }
    CHECK(bits(animation.angle_of({0})) == bits(animation.angle_of({60})));
    CHECK(animation.angle_of({15}).value == 25.0);
    CHECK(animation.angle_of({45}).value == -25.0);
}

TEST_CASE("ping-pong sweeps from one end to the other, and each frame has a pose of its own", "[unit]") {
    Animation animation;
    animation.playback = Playback::ping_pong;
    CHECK(animation.angle_of({0}).value == -25.0);
    CHECK(animation.angle_of({30}).value == 0.0);
    CHECK(animation.angle_of({60}).value == 25.0);
    for (int k = 0; k < 60; ++k) {
        CHECK(animation.angle_of({k}) < animation.angle_of({k + 1}));
        CHECK(animation.angle_of({k}).value == -animation.angle_of({60 - k}).value);
    }
    CHECK(distinct_poses(animation).angles.size() == 61);
    CHECK(animation.steps_per_period() == 120);
    CHECK(animation.frame_at_step(60).value == 60);
    CHECK(animation.frame_at_step(61).value == 59);
    CHECK(animation.frame_at_step(119).value == 1);
    CHECK(animation.frame_at_step(120).value == 0);
}

TEST_CASE("every frame has the angle of its pose, whatever the number of frames", "[unit]") {
    for (const Playback playback : {Playback::cycle, Playback::ping_pong}) {
        for (int frames = 1; frames <= 130; ++frames) {
            Animation animation;
            animation.frame_count = frames;
            animation.playback = playback;
            const PoseTable poses = distinct_poses(animation);
            for (int k = 0; k < frames; ++k) {
                const PoseIndex pose = poses.pose_of(0, {k});
                REQUIRE(bits(poses.object_of(pose).angle) == bits(animation.angle_of({k})));
            }
        }
    }
}

TEST_CASE("eight seconds at 120 Hz are 240 frames of 4 refreshes, four cycles of 60", "[unit]") {
    const Animation animation;
    const PageCycle cycle = make_page_cycle(animation, 120.0);
    CHECK(animation.shown_frame_count() == 240);
    CHECK(cycle.total_refreshes == 960);
    CHECK(cycle.entries.size() == 60);
    CHECK(cycle.entry_of_refresh.size() == 240);
    for (int refresh = 0; refresh < 960; ++refresh) {
        const PageCycleEntry& entry = cycle.entry_at(refresh);
        REQUIRE(entry.frame.value == refresh / 4 % 60);
        REQUIRE(entry.pose == distinct_poses(animation).pose_of(0, entry.frame));
        REQUIRE(entry.refreshes == 4);
    }
}

TEST_CASE("only whole multiples of the frame rate are presented, 119.88 Hz counting as 120", "[unit]") {
    CHECK(refreshes_per_frame(30.0, 120.0) == 4);
    CHECK(refreshes_per_frame(30.0, 119.88) == 4);
    CHECK(refreshes_per_frame(36.0, 144.06) == 4);
    CHECK(refreshes_per_frame(30.0, 60.0) == 2);
    CHECK(refreshes_per_frame(30.0, 30.0) == 1);
    CHECK(refreshes_per_frame(30.0, 100.0) == 0);
    CHECK(refreshes_per_frame(30.0, 24.0) == 0);
    CHECK(refreshes_per_frame(30.0, 10.0) == 0);
    CHECK_THROWS_AS(make_page_cycle(Animation{}, 100.0), InputError);
}

TEST_CASE("a still object has one pose, and a light that turns makes pictures and no poses", "[unit]") {
    Animation still;
    still.kind = MotionKind::still;
    still.angle = {40.0};
    CHECK_FALSE(still.moves());
    CHECK(distinct_poses(still).angles == std::vector<ObjectPose>{{40.0}});
    CHECK(still.pictures() == std::vector<Pose>{{{40.0}, {0.0}}});
    CHECK(still.largest_turn().value == 40.0);

    Animation lamp = still;
    lamp.light_amplitude = {30.0};
    CHECK(lamp.moves());
    CHECK(distinct_poses(lamp).angles.size() == 1);
    CHECK(lamp.pictures().size() == 31);
    CHECK(lamp.pose_of({15}) == Pose{{40.0}, {30.0}});
    CHECK(lamp.pose_of({45}) == Pose{{40.0}, {-30.0}});

    // In step with the object, it makes no more pictures than that has poses.
    Animation both;
    both.light_amplitude = {90.0};
    CHECK(both.pictures().size() == distinct_poses(both).angles.size());
    CHECK(both.pose_of({15}) == Pose{{25.0}, {90.0}});
}

TEST_CASE("a turn goes about its angle, and cameras have to allow for the farthest", "[unit]") {
    Animation turn;
    turn.angle = {100.0};
    CHECK(turn.angle_of({0}).value == 100.0);
    CHECK(turn.angle_of({15}).value == 125.0);
    CHECK(turn.largest_turn().value == 125.0);
    turn.angle = {300.0}; // as -60
    CHECK(turn.largest_turn().value == Approx(85.0));
    turn.amplitude = {170.0};
    CHECK(turn.largest_turn().value == 180.0);
}

TEST_CASE("motions that come through the same angle share its pose", "[unit]") {
    Animation turn, half;
    half.amplitude = {12.5};
    half.frame_count = 5;
    Animation still;
    still.kind = MotionKind::still;
    still.frame_count = 1;
    still.angle = {12.5}; // 25 sin(30 deg), but for its last bits
    PoseTable poses;
    for (const Animation& motion : {turn, half, still})
        poses.add(motion);
    CHECK(poses.count() == 31);
    CHECK(poses.pose_of(2, {0}) == poses.pose_of(0, {5}));
    CHECK(poses.pose_of(1, {1}) == poses.pose_of(0, {5}));
    CHECK(poses.pose_of(1, {3}) == poses.pose_of(0, {35}));
    CHECK(poses.index_of({-12.5}) == poses.pose_of(0, {35}));
    // Each motion goes through its own.
    const PageCycle cycle = make_page_cycle(half, poses.frames_of(1), 120.0);
    CHECK(cycle.entries.size() == 4);
    CHECK(cycle.entries[1].pose == poses.pose_of(0, {5}));
    const std::vector<double> seconds = seconds_of_poses(half, poses, 1);
    CHECK(seconds[static_cast<std::size_t>(poses.pose_of(0, {5}).value)] == Approx(2.0));
    CHECK(seconds[static_cast<std::size_t>(poses.pose_of(0, {15}).value)] == 0.0);
}

TEST_CASE("each picture of a motion is lit for its time", "[unit]") {
    Animation lamp;
    lamp.kind = MotionKind::still;
    lamp.light_amplitude = {10.0};
    lamp.frame_count = 5; // there, left, there, right, there
    lamp.frame_rate_hz = 4.0;
    lamp.duration_s = 2.0;
    const ShownPictures shown = shown_pictures(lamp, distinct_poses(lamp).frames_of(0));
    CHECK(shown.of_frame == std::vector<int>{0, 1, 0, 2, 0});
    CHECK(shown.poses == std::vector<PoseIndex>(3));
    CHECK(shown.seconds == std::vector<double>{1.0, 0.5, 0.5});
}
