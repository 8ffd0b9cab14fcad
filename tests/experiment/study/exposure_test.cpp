/// What presentations show, against geometry; and the error budget of fixations on a ball.
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "experiment/study/error_budget.h"
#include "experiment/study/read/exposure.h"
#include "experiment/study/study_maps.h"
#include "experiment/surface/euclidean_kernel.h"
#include "tests/experiment/study/painted_study.h"
#include "tests/support/cast_maps.h"

using namespace overt;

namespace {

struct ShownBall {
    test::CastScene scene;
    CoordinateMaps maps;
    Animation animation;
    PoseTable poses;

    ShownBall(Mesh mesh, glm::ivec2 image_px, double turn_deg = 25.0)
        : scene(std::move(mesh), {{{-turn_deg}}, {{0.0}}, {{turn_deg}}}, image_px),
          maps(scene.mesh, scene.scene, scene.angles,
               {scene.map(PoseIndex{0}), scene.map(PoseIndex{1}), scene.map(PoseIndex{2})}) {
        // Three frames, each with a pose of its own.
        animation.frame_count = 3;
        animation.playback = Playback::ping_pong;
        animation.frame_rate_hz = 1.0;
        animation.duration_s = 3.0;
        poses.angles = scene.angles;
        poses.of_motion = {{PoseIndex{0}, PoseIndex{1}, PoseIndex{2}}};
    }
    /// Of a place of a ball of radius 1: the plane that touches it there has the camera before it.
    double seconds_of(const glm::vec3& position) const {
        double seconds = 0.0;
        for (int pose = 0; pose < 3; ++pose)
            seconds += glm::dot(glm::dvec3(position), maps.sight_lines(PoseIndex{pose}).origin()) > 1.0;
        return seconds;
    }
};

} // namespace

TEST_CASE("vertices are visible where geometry says so, also those between the centres of pixels", "[unit]") {
    // Some five triangles of the ball to each pixel: the centres miss many.
    const ShownBall ball(test::icosphere(1.0, 6), {96, 96});
    const Exposure exposure = exposure_of(ball.maps, seconds_of_poses(ball.animation, ball.poses, 0));
    double shown_s = 0.0, true_s = 0.0;
    int by_centres = 0, by_truth = 0, wrongly_never = 0, wrongly_ever = 0;
    for (std::size_t v = 0; v < ball.scene.mesh.positions.size(); ++v) {
        const double seconds = ball.seconds_of(ball.scene.mesh.positions[v]);
        true_s += seconds;
        shown_s += static_cast<double>(exposure.seconds_visible[v]);
        by_truth += seconds > 0.0;
        by_centres += exposure.pixel_seconds[v] > 0.0;
        wrongly_never += seconds > 0.0 && exposure.seconds_visible[v] <= 0.0f;
        wrongly_ever += seconds <= 0.0 && exposure.seconds_visible[v] > 0.0f;
    }
    INFO(by_truth << " visible, " << by_centres << " by the centres of pixels");
    CHECK(by_centres < 0.8 * by_truth);
    CHECK(shown_s == Approx(true_s).epsilon(0.01));
    CHECK(wrongly_never < 0.01 * by_truth);
    CHECK(wrongly_ever < 0.01 * by_truth);
}

TEST_CASE("what a nearer sheet hides is not visible", "[unit]") {
    // Two squares upright, one behind the other: the one behind is seen at no angle of 5 degrees or less.
    Mesh mesh = test::flat_square(1.0, 40);
    const auto in_front = static_cast<std::uint32_t>(mesh.positions.size());
    Mesh behind = test::flat_square(0.5, 40);
    for (glm::vec3& p : mesh.positions)
        p = {p.x, -0.2f, p.y};
    for (const glm::vec3& p : behind.positions)
        mesh.positions.emplace_back(p.x, 0.2f, p.y);
    for (const glm::uvec3& t : behind.triangles)
        mesh.triangles.push_back(t + in_front);
    mesh.triangle_parts.assign(mesh.triangles.size(), PartIndex{0});
    const ShownBall squares(std::move(mesh), {96, 96}, 5.0);
    const Exposure exposure =
        exposure_of(squares.maps, seconds_of_poses(squares.animation, squares.poses, 0));
    int seen_in_front = 0, seen_behind = 0;
    for (std::size_t v = 0; v < exposure.seconds_visible.size(); ++v)
        (v < in_front ? seen_in_front : seen_behind) += exposure.seconds_visible[v] > 0.0f;
    CHECK(seen_in_front == static_cast<int>(in_front));
    CHECK(seen_behind == 0);
}

TEST_CASE("exposure is shared among the parts as the picture shows them", "[unit]") {
    Mesh mesh = test::icosphere(1.0, 6);
    mesh.part_names = {"below", "above"};
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        mesh.triangle_parts[t] = mesh.positions[mesh.triangles[t].x].z > 0.0f ? 1 : 0;
    const ShownBall ball(std::move(mesh), {160, 160});
    const Exposure exposure = exposure_of(ball.maps, seconds_of_poses(ball.animation, ball.poses, 0));
    const double away = glm::length(ball.maps.sight_lines(PoseIndex{1}).origin());
    const double px = ball.maps.sight_lines(PoseIndex{1}).pixel_width_at(away);
    const auto rows = exposure_rows({exposure, ball.scene.mesh, 10.0, 100.0 * px * px}, 0,
                                    Areas(ball.scene.mesh.part_names));
    REQUIRE(rows.size() == 3);
    CHECK(rows[0].area.empty());
    CHECK(rows[0].area_mm2 == Approx(4.0 * std::numbers::pi * 100.0).epsilon(0.01));
    double true_s = 0.0, never = 0.0;
    for (const glm::vec3& position : ball.scene.mesh.positions) {
        true_s += ball.seconds_of(position) / static_cast<double>(ball.scene.mesh.positions.size());
        never += (ball.seconds_of(position) <= 0.0) / static_cast<double>(ball.scene.mesh.positions.size());
    }
    CHECK(rows[0].never_visible == Approx(never).margin(0.01));
    CHECK(rows[0].seconds_visible == Approx(true_s).epsilon(0.02));
    CHECK(rows[0].share_of_exposure == Approx(1.0));
    CHECK(rows[1].share_of_exposure + rows[2].share_of_exposure == Approx(1.0));
    CHECK(rows[1].share_of_exposure == Approx(0.5).margin(0.02));
    // Each pixel is of one part, and a third of each corner of its triangle.
    double of_vertices = 0.0, of_parts = 0.0;
    for (const double seconds : exposure.pixel_seconds)
        of_vertices += seconds;
    for (const double seconds : exposure.part_pixel_seconds)
        of_parts += seconds;
    CHECK(of_vertices == Approx(of_parts).epsilon(1e-4));
    // The disc that the ball fills in the plane through its middle, over the cap that is seen.
    const double sine = 1.0 / away, tangent = sine / std::sqrt(1.0 - sine * sine);
    const double disc = away * away * tangent * tangent, cap = 2.0 * (1.0 - sine);
    REQUIRE(rows[0].foreshortening);
    CHECK(*rows[0].foreshortening == Approx(disc / cap).epsilon(0.03));
}

TEST_CASE("the error budget is what its parts say, in millimetres", "[unit]") {
    test::PaintedStudy study(
        2, 1, 5, [](int, int, RandomStream& random) { return test::near(test::front, 0.2, random); });
    StudyResults& results = study.results;
    for (StudyTrial& trial : results.trials) {
        trial.quality.accuracy_deg = 0.4;
        trial.quality.rms_s2s_deg = 0.1;
        trial.clock_uncertainty_s = 0.002;
        for (int frame = 0; frame < 240; ++frame) // 30 degrees a second, evenly
            trial.turns.push_back({frame / 30.0, 1.0 * frame, frame});
    }
    for (StudyFixation& fixation : results.fixations) {
        fixation.onset_s = 1.0;
        fixation.samples = 100;
        fixation.position = {0.0, -100.0, 0.0};
        fixation.cone_mm = 9.0;
        fixation.lut_mm = 0.5;
        fixation.cone_at_edge = fixation.trial == 0 ? 0.0 : 0.25;
    }
    results.maps = maps_on(results, 0, study.surfaces[0], nullptr);
    REQUIRE(results.maps.size() == 2);
    add_error_budget(results, 0, study.surfaces[0]);
    const ErrorBudget& error = results.maps[0].error;
    const double precision = 0.1 / std::sqrt(2.0) * 30.0,
                 timing = 30.0 * 3.14159265 / 180.0 * 100.0 * 0.002 / std::sqrt(3.0);
    CHECK(*error.accuracy_mm == Approx(9.0));
    CHECK(*error.precision_mm == Approx(precision));
    CHECK(*error.timing_mm == Approx(timing).epsilon(1e-6));
    CHECK(*error.lut_mm == Approx(0.5));
    CHECK(*error.together_mm ==
          Approx(std::sqrt(81.0 + precision * precision + timing * timing + 0.25)).epsilon(1e-6));
    CHECK(*error.at_edge == Approx(0.125));
    CHECK(*error.near_edge == Approx(0.5));
    // A ball has no other sheet near: what is beyond three sigmas is what a plane has, and a little less.
    CHECK(*results.maps[0].euclidean_leak == Approx(EuclideanKernel::share_on_a_plane).margin(0.012));

    // Without a validation nobody knows the accuracy, nor the sum.
    results.trials[0].quality.accuracy_deg.reset();
    add_error_budget(results, 0, study.surfaces[0]);
    CHECK(!results.maps[0].error.accuracy_mm);
    CHECK(!results.maps[0].error.together_mm);
    CHECK(results.maps[0].error.timing_mm);

    // An object that stands still needs no clock.
    results.trials[0].turns.resize(1);
    CHECK(surface_speed_mm_s(results.fixations[0], results.trials[0], results.objects[0]) == 0.0);
}

TEST_CASE("a surface is as fast as its turns about the axis take it, of the frames about a fixation",
          "[unit]") {
    StudyObject object;
    object.mm_per_unit = 2.0;
    object.axis_point = {5.0, 7.0, 0.0};
    StudyFixation fixation;
    fixation.position = {8.0, 11.0, 99.0}; // 5 units from the axis
    fixation.onset_s = 1.05;
    fixation.duration_s = 0.2;
    StudyTrial trial;
    CHECK_FALSE(surface_speed_mm_s(fixation, trial, object));
    // Angles go up by 1, 2, 3, ... degrees, and every third time down by so much.
    double angle_deg = 0.0;
    for (int i = 0; i < 20; ++i) {
        angle_deg += i % 3 == 2 ? -i : i;
        trial.turns.push_back({0.1 * i, angle_deg, i});
    }
    // On 1.05 to 1.25 s: the turns from 0.9 s on (10, 11, 12, 13, and one after: 0.9 to 1.3).
    const double turned = 10.0 + 11.0 + 12.0 + 13.0;
    CHECK(surface_speed_mm_s(fixation, trial, object).value() ==
          Approx(turned * std::numbers::pi / 180.0 / 0.4 * 5.0 * 2.0));
    // At the end there is none after it, at the beginning none before.
    fixation.onset_s = 1.85;
    CHECK(surface_speed_mm_s(fixation, trial, object).value() ==
          Approx((18.0 + 19.0) * std::numbers::pi / 180.0 / 0.2 * 10.0));
    fixation.onset_s = -0.5;
    fixation.duration_s = 0.55;
    CHECK(surface_speed_mm_s(fixation, trial, object).value() ==
          Approx(1.0 * std::numbers::pi / 180.0 / 0.1 * 10.0));
    trial.turns.resize(1);
    CHECK(surface_speed_mm_s(fixation, trial, object).value() == 0.0);
    // Two turns at one time say nothing of a speed.
    trial.turns.push_back(trial.turns.front());
    trial.turns.back().angle_deg += 9.0;
    fixation.onset_s = 0.0;
    CHECK(surface_speed_mm_s(fixation, trial, object).value() == 0.0);
    object.mm_per_unit.reset();
    CHECK_FALSE(surface_speed_mm_s(fixation, trial, object));
}
