#include <cmath>

#include <catch2/catch.hpp>
#include <glm/gtc/quaternion.hpp>

#include "experiment/animation.h"
#include "experiment/motion_words.h"
#include "experiment/scene/viewing.h"

using namespace overt;

namespace {

Animation motion_of(MotionKind kind, int frames = 61) {
    Animation motion;
    motion.kind = kind;
    motion.frame_count = frames;
    motion.amplitude = {20.0};
    return motion;
}

/// Where a point of an object about the origin comes to lie.
glm::dvec3 placed(const ObjectPose& object, glm::dvec3 point) {
    return glm::dvec3(TurntablePose{glm::dvec3(0.0), object}.world_from_object() * glm::dvec4(point, 1.0));
}

bool is_near(glm::dvec3 a, glm::dvec3 b) { return glm::distance(a, b) < 1e-12; }

} // namespace

TEST_CASE("a turntable goes all the way round at one speed, and closes without a doubled frame", "[unit]") {
    Animation motion = motion_of(MotionKind::turntable, 37);
    for (int k = 0; k < 36; ++k) {
        const double step = motion.angle_of({k + 1}).value - motion.angle_of({k}).value;
        CHECK(std::remainder(step, 360.0) == Approx(10.0));
    }
    CHECK(motion.angle_of({0}).value == 0.0);
    CHECK(motion.angle_of({9}).value == 90.0); // counter-clockwise seen from above
    CHECK(motion.angle_of({18}).value == 180.0);
    CHECK(motion.angle_of({27}).value == -90.0);
    CHECK(motion.pose_of({36}) == motion.pose_of({0}));
    CHECK(motion.pictures().size() == 36);
    CHECK(motion.steps_per_period() == 36);
    CHECK(motion.frame_at_step(35).value == 35);
    CHECK(motion.frame_at_step(36).value == 0);
    CHECK(motion.largest_turn().value == 180.0);
    motion.turns = -1;
    CHECK(motion.angle_of({9}).value == -90.0);
    motion.turns = 2;
    CHECK(motion.angle_of({9}).value == 180.0);
    CHECK(motion.pictures().size() == 18);
    motion.turns = 1;
    motion.angle = {170.0};
    CHECK(motion.angle_of({2}).value == -170.0);
}

TEST_CASE("a triangle goes from end to end at one speed, and may be eased", "[unit]") {
    Animation motion = motion_of(MotionKind::triangle);
    for (int k = 0; k < 60; ++k) {
        const double step = motion.angle_of({k + 1}).value - motion.angle_of({k}).value;
        CHECK(std::abs(step) == Approx(80.0 / 60.0));
        CHECK((step > 0.0) == (k < 15 || k >= 45));
    }
    CHECK(motion.angle_of({15}).value == 20.0);
    CHECK(motion.angle_of({45}).value == -20.0);
    CHECK(motion.pose_of({60}) == motion.pose_of({0}));
    CHECK(motion.pictures().size() == 31);
    motion.ease = MotionEase::minimum_jerk;
    // A quarter of the time from one end to the other: s = 1/4, 10 s^3 - 15 s^4 + 6 s^5 = 0.103515625.
    motion.playback = Playback::ping_pong;
    CHECK(motion.angle_of({0}).value == -20.0);
    CHECK(motion.angle_of({15}).value == Approx(-20.0 + 40.0 * 0.103515625));
    CHECK(motion.angle_of({30}).value == 0.0);
    CHECK(motion.angle_of({45}).value == -motion.angle_of({15}).value);
    CHECK(motion.angle_of({60}).value == 20.0);
}

TEST_CASE("a trapezoid rests at its ends for its share of the time", "[unit]") {
    Animation motion = motion_of(MotionKind::trapezoid, 41);
    motion.rest_share = 0.5; // of 40 steps 10 at each end, 5 to each side of it
    int at_right = 0, at_left = 0;
    for (int k = 0; k < 40; ++k) {
        at_right += motion.angle_of({k}).value == 20.0;
        at_left += motion.angle_of({k}).value == -20.0;
    }
    CHECK(at_right == 11);
    CHECK(at_left == 11);
    CHECK(motion.angle_of({0}).value == 0.0);
    CHECK(motion.angle_of({1}).value == Approx(4.0));
    CHECK(motion.angle_of({5}).value == 20.0);
    CHECK(motion.angle_of({15}).value == 20.0);
    CHECK(motion.angle_of({16}).value == Approx(16.0));
    CHECK(motion.pictures().size() == 11);
    motion.rest_share = 0.0;
    const Animation triangle = motion_of(MotionKind::triangle, 41);
    for (int k = 0; k <= 40; ++k)
        CHECK(motion.pose_of({k}) == triangle.pose_of({k}));
}

TEST_CASE("steps stand at each angle for as many frames, and need a picture each", "[unit]") {
    Animation motion = motion_of(MotionKind::steps, 13);
    motion.angles_deg = {-30.0, 0.0, 45.0};
    motion.angle = {10.0};
    const std::vector<double> expected{-20, -20, -20, -20, 10, 10, 10, 10, 55, 55, 55, 55, -20};
    for (int k = 0; k < 13; ++k)
        CHECK(motion.angle_of({k}).value == expected[static_cast<std::size_t>(k)]);
    CHECK(motion.pictures().size() == 3);
    motion.playback = Playback::ping_pong;
    CHECK(motion.angle_of({12}).value == 55.0);
}

TEST_CASE("a sum of sines adds them with their phases, and closes to the bit", "[unit]") {
    Animation motion = motion_of(MotionKind::waves, 49);
    motion.waves = {{20.0, 1.0, 0.0}, {5.0, 3.0, 90.0}};
    for (int k = 0; k <= 48; ++k) {
        const double phase = 2.0 * std::numbers::pi * k / 48.0;
        CHECK(motion.angle_of({k}).value ==
              Approx(20.0 * std::sin(phase) + 5.0 * std::cos(3.0 * phase)).margin(1e-12));
    }
    CHECK(motion.angle_of({48}).value == motion.angle_of({0}).value);
    CHECK(motion.angle_of({0}).value == 5.0);
}

TEST_CASE("a camera in orbit is object and light turned the other way", "[unit]") {
    Animation motion = motion_of(MotionKind::orbit, 37);
    const Pose quarter = motion.pose_of({9});
    CHECK(quarter.object == ObjectPose{{-90.0}});
    CHECK(quarter.light.value == -90.0);
    // From its right-hand side, at +x, a camera that went a quarter round sees what was at +x in front, at
    // -y.
    CHECK(is_near(placed(quarter.object, {1.0, 0.0, 0.0}), {0.0, -1.0, 0.0}));
    CHECK(motion.pose_of({36}) == motion.pose_of({0}));
    CHECK(motion.turns_light());
    motion.angle = {10.0};
    CHECK(motion.pose_of({9}).object == ObjectPose{{-80.0}});
    CHECK(motion.pose_of({9}).light.value == -90.0);
}

TEST_CASE("an approach comes nearer to the front and goes back", "[unit]") {
    Animation motion = motion_of(MotionKind::approach, 41);
    motion.approach = 30.0;
    CHECK(motion.object_in({0}).is_turn());
    CHECK(motion.object_in({20}).shift == glm::dvec3(0.0, -30.0, 0.0));
    CHECK(motion.object_in({10}).shift.y == Approx(-15.0));
    CHECK(motion.object_in({10}) == motion.object_in({30}));
    CHECK(motion.pictures().size() == 21);
    CHECK_FALSE(motion.only_turns());
    motion.playback = Playback::ping_pong;
    CHECK(motion.object_in({40}).shift.y == -30.0);
}

TEST_CASE("an object turns about any axis and pivot, and about the vertical as ever", "[unit]") {
    Animation motion = motion_of(MotionKind::turn);
    const Animation plain = motion;
    motion.axis = {0.0, 0.0, 2.0};
    CHECK(motion.pose_of({7}) == plain.pose_of({7}));
    motion.axis = {0.0, 0.0, -1.0};
    CHECK(motion.angle_of({7}).value == -plain.angle_of({7}).value);
    // About the line of sight, then about the axis to the right: right-handed.
    CHECK(is_near(placed(turned_about({0.0, 1.0, 0.0}, {}, {90.0}), {1.0, 0.0, 0.0}), {0.0, 0.0, -1.0}));
    CHECK(is_near(placed(turned_about({1.0, 0.0, 0.0}, {}, {90.0}), {0.0, 1.0, 0.0}), {0.0, 0.0, 1.0}));
    // What lies on the axis stays, whatever the pivot, and `before` comes first.
    const ObjectPose hinged = turned_about({1.0, 0.0, 0.0}, {0.0, 0.0, -5.0}, {30.0}, {90.0});
    CHECK(is_near(placed(hinged, {3.0, 0.0, -5.0}), placed(hinged, {3.0, 0.0, -5.0})));
    CHECK(is_near(placed(turned_about({1.0, 0.0, 0.0}, {0.0, 0.0, -5.0}, {30.0}), {3.0, 0.0, -5.0}),
                  {3.0, 0.0, -5.0}));
    CHECK(is_near(placed(hinged, {0.0, -3.0, -5.0}), {3.0, 0.0, -5.0}));
    const ObjectPose aside = turned_about({0.0, 0.0, 1.0}, {4.0, 0.0, 0.0}, {180.0});
    CHECK(is_near(placed(aside, {0.0, 0.0, 0.0}), {8.0, 0.0, 0.0}));
    // A ray comes back from where it went.
    const Ray ray = to_object({placed(hinged, {1.0, 2.0, 3.0}), {0.0, 1.0, 0.0}}, {glm::dvec3(0.0), hinged});
    CHECK(is_near(ray.origin, {1.0, 2.0, 3.0}));
    CHECK(glm::length(ray.direction) == Approx(1.0));
    motion.axis = {1.0, 0.0, 0.0};
    CHECK(motion.pose_of({60}) == motion.pose_of({0}));
    CHECK(motion.pictures().size() == 31);
}

TEST_CASE("between two ways to stand lies the shortest way", "[unit]") {
    CHECK(between({{170.0}}, {{-170.0}}, 0.5).angle.value == Approx(180.0));
    CHECK(between({{10.0}}, {{20.0}}, 0.25) == ObjectPose{{12.5}});
    // Shoemake's great arc: a quarter of a turn about x, at a quarter of the way.
    const ObjectPose turned = turned_about({1.0, 0.0, 0.0}, {}, {90.0});
    const ObjectPose quarter = between({}, turned, 0.25);
    CHECK(quarter.tilt.x == Approx(0.195090));
    CHECK(quarter.tilt.w == Approx(0.980785));
    CHECK(object_pose_of({std::sqrt(0.5), 0.0, 0.0, std::sqrt(0.5)}, {}).angle.value == Approx(90.0));
    CHECK(object_pose_of({-std::sqrt(0.5), 0.0, 0.0, -std::sqrt(0.5)}, {}).is_turn());
}

TEST_CASE("a light that goes round needs pictures and no maps, and poses that coincide are made once",
          "[unit]") {
    Animation lamp = motion_of(MotionKind::still, 37);
    lamp.light_turns = 1;
    CHECK(lamp.moves());
    CHECK(lamp.pictures().size() == 36);
    CHECK(lamp.pose_of({9}).light.value == 90.0);
    CHECK(lamp.pose_of({36}) == lamp.pose_of({0}));
    PoseTable poses = distinct_poses(lamp);
    CHECK(poses.count() == 1);
    // A turntable of the same steps, a still object at one of its angles, an orbit: all in the same poses.
    poses.add(motion_of(MotionKind::turntable, 37));
    CHECK(poses.count() == 36);
    Animation still = motion_of(MotionKind::still, 1);
    still.angle = {-120.0};
    poses.add(still);
    poses.add(motion_of(MotionKind::orbit, 37));
    CHECK(poses.count() == 36);
    // Tilted ones are others, though all are at the same angle about the vertical.
    Animation rock = motion_of(MotionKind::turn, 5);
    rock.axis = {1.0, 0.0, 0.0};
    poses.add(rock);
    CHECK(poses.count() == 38);
    CHECK(poses.index_of(rock.object_in({1})) == poses.pose_of(4, {1}));
}

TEST_CASE("each kind is said in words", "[unit]") {
    Animation motion = motion_of(MotionKind::turntable);
    CHECK(way_of(motion) == "once all the way round, counter-clockwise");
    motion.turns = -2;
    CHECK(way_of(motion) == "2 times all the way round, clockwise");
    motion.light_turns = 1;
    CHECK(way_of_light(motion) == "once all the way round, counter-clockwise");
    for (const MotionKind kind : all_kinds<MotionKind>)
        CHECK_FALSE(way_of(motion_of(kind)).empty());
}
