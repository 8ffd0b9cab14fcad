/// Whether gaze goes with the surface while a fixation lasts, from gaze whose share of the motion is known.
#include "experiment/study/gaze_motion.h"

#include <array>
#include <cmath>

#include <catch2/catch.hpp>

#include "experiment/base/random.h"
#include "experiment/study/fixations/surface_fixations.h"
#include "tests/experiment/study/painted_study.h"
#include "tests/support/cast_maps.h"

using namespace overt;
using namespace overt::test;
using namespace std::chrono_literals;

namespace {

/// A ball that turns on by a degree every 33 ms, seen by a tracker of 1000 Hz for 400 ms.
struct TurningBall {
    TurningBall()
        : scene(ball({0.0, 0.0, 0.0}, 60.0), angles()), maps(scene.maps()),
          point(*maps.surface_at(PoseIndex{6}, {80.0, 80.0})) {}

    static std::vector<ObjectPose> angles() {
        std::vector<ObjectPose> all;
        for (int pose = 0; pose < 13; ++pose)
            all.push_back({{pose - 6.0}});
        return all;
    }

    /// Gaze that goes this share of the point's way, and scatters about it.
    StudyFixation fixation(double gain, double noise_px, std::uint64_t seed = 1) const {
        const std::array clocks{ClockPair{SessionTime(0s), TrackerTime(0s), SessionTime(0s)},
                                ClockPair{SessionTime(100s), TrackerTime(100s), SessionTime(100s)}};
        const std::optional<ClockMap> clock_map{ClockMap(clocks)};
        RandomStream random(seed, "scatter of gaze");
        std::vector<PlacedSample> samples;
        for (int i = 0; i < 400; ++i) {
            PlacedSample sample;
            sample.sampled_at = TrackerTime(1s + std::chrono::milliseconds(i));
            sample.frame = i / 33;
            sample.pose = PoseIndex{std::min(i / 33, 12)};
            const glm::dvec2 seen(maps.sight_lines(sample.pose).project(point.position));
            sample.gaze = screen.screen_from_image(glm::dvec2(70.0, 90.0) + gain * seen +
                                                   noise_px * glm::dvec2(random.normal(), random.normal()));
            sample.has_gaze = sample.has_time = sample.is_on_surface = true;
            sample.surface = point;
            samples.push_back(sample);
        }
        GazeEvent event;
        event.kind = GazeEvent::Kind::fixation;
        event.start = samples.front().sampled_at;
        event.end = samples.back().sampled_at;
        event.duration = event.end - event.start;
        const StudyOptions options;
        const std::optional<ObjectScale> scale = ObjectScale{1.0, 1000.0, 30.0};
        return *surface_fixation(event, {.options = options,
                                         .samples = samples,
                                         .clock_map = clock_map,
                                         .onset = SessionTime(1s),
                                         .presentation_s = 8.0,
                                         .angles = scene.angles,
                                         .scale = scale,
                                         .has_surface = true,
                                         .lookup = &maps,
                                         .screen = &screen});
    }

    /// Gaze that goes this share of the way of a point somewhere on the ball, seen by a tracker that errs by
    /// the same amount all the time; nothing if it is then beside the ball.
    std::optional<StudyFixation> erring_fixation(double gain, double sigma_px, std::uint64_t seed) const {
        const std::array clocks{ClockPair{SessionTime(0s), TrackerTime(0s), SessionTime(0s)},
                                ClockPair{SessionTime(100s), TrackerTime(100s), SessionTime(100s)}};
        const std::optional<ClockMap> clock_map{ClockMap(clocks)};
        RandomStream random(seed, "erring gaze");
        const glm::dvec2 place = glm::dvec2(80.0) + 22.0 * glm::dvec2(random.normal(), random.normal());
        const auto aimed_at = maps.surface_at(PoseIndex{6}, place);
        const glm::dvec2 error = sigma_px * glm::dvec2(random.normal(), random.normal());
        if (!aimed_at)
            return std::nullopt;
        std::vector<PlacedSample> samples;
        for (int i = 0; i < 390; i += 5) {
            PlacedSample sample;
            sample.sampled_at = TrackerTime(1s + std::chrono::milliseconds(i));
            sample.frame = i / 30;
            sample.pose = PoseIndex{i / 30};
            const glm::dvec2 seen(maps.sight_lines(sample.pose).project(aimed_at->position));
            const glm::dvec2 gaze = place + gain * (seen - place) + error;
            sample.gaze = screen.screen_from_image(gaze);
            sample.has_gaze = sample.has_time = true;
            if (const auto surface = maps.surface_at(sample.pose, gaze)) {
                sample.is_on_surface = true;
                sample.surface = *surface;
            }
            samples.push_back(sample);
        }
        GazeEvent event;
        event.kind = GazeEvent::Kind::fixation;
        event.start = samples.front().sampled_at;
        event.end = samples.back().sampled_at;
        event.duration = event.end - event.start;
        const StudyOptions options;
        const std::optional<ObjectScale> scale = ObjectScale{1.0, 1000.0, 30.0};
        const double accuracy = sigma_px / screen.px_per_deg_at_centre() / 0.798;
        const GazeCone cone(screen, Degrees{accuracy}, 64);
        const auto fixation = surface_fixation(event, {.options = options,
                                                       .samples = samples,
                                                       .clock_map = clock_map,
                                                       .onset = SessionTime(1s),
                                                       .presentation_s = 8.0,
                                                       .angles = scene.angles,
                                                       .scale = scale,
                                                       .has_surface = true,
                                                       .lookup = &maps,
                                                       .cone = &cone,
                                                       .is_accuracy_known = sigma_px > 0.0,
                                                       .screen = &screen});
        return fixation->counted() ? fixation : std::nullopt;
    }

    CastScene scene;
    CoordinateMaps maps;
    SurfacePoint point;
    ScreenGeometry screen;
};

} // namespace

TEST_CASE("gaze that goes a share of the surface's way has that gain, and noise does not make it less",
          "[unit]") {
    const TurningBall ball;
    for (const double gain : {0.0, 0.4, 1.0}) {
        const StudyFixation fixation = ball.fixation(gain, 0.0);
        REQUIRE(fixation.surface_way_deg2 > 0.0);
        CHECK(fixation.gaze_with_surface_deg2 / fixation.surface_way_deg2 == Approx(gain).margin(1e-9));
        // Twelve steps of a degree, of a point that lies the ball's radius in front of the axis.
        const double way_px =
            glm::distance(glm::dvec2(ball.maps.sight_lines(PoseIndex{0}).project(ball.point.position)),
                          glm::dvec2(ball.maps.sight_lines(PoseIndex{12}).project(ball.point.position)));
        const double way_deg = way_px / ball.screen.px_per_deg_at_centre();
        CHECK(fixation.surface_deg_s == Approx(way_deg / fixation.duration_s).epsilon(0.01));
    }
    double sum = 0.0, squares = 0.0;
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        const StudyFixation fixation = ball.fixation(0.7, 3.0, seed);
        const double gain = fixation.gaze_with_surface_deg2 / fixation.surface_way_deg2;
        sum += gain;
        squares += gain * gain;
    }
    const double mean = sum / 200, error = std::sqrt((squares / 200 - mean * mean) / 199);
    CHECK(std::abs(mean - 0.7) < 4.0 * error);
    CHECK(error < 0.01);
}

TEST_CASE("an observer's gain is the slope over all fixations, and the study's the mean over observers",
          "[unit]") {
    PaintedStudy study(3, 2, 4, [](int, int, RandomStream&) { return front; });
    // In "smooth" gaze goes with the surface, in "rough" half of the way; the fourth fixations saw no motion.
    for (std::size_t i = 0; i < study.results.fixations.size(); ++i) {
        StudyFixation& fixation = study.results.fixations[i];
        const bool smooth =
            study.results.trials[static_cast<std::size_t>(fixation.trial)].key("material") == "smooth";
        fixation.surface_way_deg2 = i % 4 == 3 ? 0.0 : 0.1 * static_cast<double>(1 + i % 4);
        fixation.gaze_with_surface_deg2 = (smooth ? 1.0 : 0.5) * fixation.surface_way_deg2;
        fixation.surface_deg_s = 2.0;
    }
    const auto rows = gaze_motions(study.results, {{"material", {"smooth", "rough"}}}, study.options);
    REQUIRE(rows.size() == 3);
    CHECK(rows[0].keys.empty());
    CHECK(*rows[0].surface_gain.value == Approx(0.75));
    CHECK(rows[0].fixations == 18);
    CHECK(*rows[0].surface_speed_deg_s.value == Approx(2.0));
    CHECK(rows[1].keys == std::vector<StudyKey>{{"material", "smooth"}});
    CHECK(*rows[1].surface_gain.value == Approx(1.0));
    CHECK(*rows[2].surface_gain.value == Approx(0.5));
    CHECK(rows[2].observers == 3);

    // What projecting a point that stands leaves is no motion.
    for (StudyFixation& fixation : study.results.fixations)
        fixation.surface_way_deg2 = 1e-28;
    const auto still = gaze_motions(study.results, {}, study.options);
    CHECK_FALSE(still[0].surface_gain.value);
    CHECK(still[0].surface_gain.absent == "no counted fixation saw the surface move");
}

TEST_CASE("the tracker's constant error changes the gain, and the corrected gain comes back", "[unit]") {
    const TurningBall ball;
    // A ball of 140 px; of an object seen 11 degrees large these are errors of 0.6 and 1 degree.
    for (const double sigma_px : {0.0, 6.0, 10.0}) {
        for (const double gain : {0.0, 0.4, 1.0}) {
            PaintedStudy study(1, 1, 500, [](int, int, RandomStream&) { return front; });
            std::uint64_t seed = 0;
            for (StudyFixation& fixation : study.results.fixations) {
                std::optional<StudyFixation> made;
                while (!made)
                    made = ball.erring_fixation(gain, sigma_px, ++seed);
                fixation.duration_s = made->duration_s;
                fixation.gaze_with_surface_deg2 = made->gaze_with_surface_deg2;
                fixation.surface_way_deg2 = made->surface_way_deg2;
                fixation.displaced_motion = made->displaced_motion;
            }
            const GazeMotionRow row = gaze_motions(study.results, {}, study.options).front();
            CAPTURE(sigma_px, gain, *row.surface_gain.value, row.corrected_gain.value.value_or(-1.0));
            if (sigma_px == 0.0) {
                CHECK(*row.surface_gain.value == Approx(gain).margin(0.002));
                CHECK_FALSE(row.corrected_gain.value);
                continue;
            }
            REQUIRE(row.corrected_gain.value);
            CHECK(*row.corrected_gain.value == Approx(gain).margin(0.02));
            // On a ball points beside the one that was looked at move less, and the gain is too large.
            if (gain == 1.0)
                CHECK(*row.surface_gain.value - gain > 2.0 * std::abs(*row.corrected_gain.value - gain));
        }
    }
}

TEST_CASE("a gain is the same however small the ways and however short the fixations are", "[unit]") {
    PaintedStudy study(3, 1, 2, [](int, int, RandomStream&) { return front; });
    for (StudyFixation& fixation : study.results.fixations) {
        fixation.duration_s = 0.125;
        fixation.surface_way_deg2 = 0.02;
        fixation.gaze_with_surface_deg2 = 0.01;
        fixation.surface_deg_s = 3.0;
        fixation.displaced_motion = {{0.008, 0.03}};
    }
    study.results.fixations[0].surface_way_deg2 = 1e-6; // it stands
    const auto rows = gaze_motions(study.results, {}, study.options);
    CHECK(rows[0].fixations == 5);
    CHECK(rows[0].observers == 3);
    CHECK(*rows[0].surface_gain.value == Approx(0.5));
    CHECK(*rows[0].corrected_gain.value == Approx((2 * 0.01 - 0.008) / (2 * 0.02 - 0.03)));
    CHECK(*rows[0].surface_speed_deg_s.value == Approx(3.0));
    for (StudyFixation& fixation : study.results.fixations)
        fixation.displaced_motion.reset();
    CHECK(gaze_motions(study.results, {}, study.options)[0].corrected_gain.absent ==
          "the tracker's error is not known, or as large as the surface's way");
}
