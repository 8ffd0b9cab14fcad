/// Whether gaze is drawn by light, from gaze whose rule is known: it goes with a highlight that stays on the
/// screen, with a spot that is painted on the surface, or with neither.
#include "experiment/study/light_at_gaze.h"

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

/// A ball that turns by 10 degrees every 100 ms and is lit as `is_bright` says of a place of the image and of
/// its point on the surface.
struct LitBall {
    explicit LitBall(const std::function<bool(glm::dvec2, const glm::dvec3&)>& is_bright)
        : scene(ball({0.0, 0.0, 0.0}, 60.0), angles()), maps(scene.maps()), scores(light(is_bright)) {}

    static constexpr int poses = 9;
    static std::vector<ObjectPose> angles() {
        std::vector<ObjectPose> all;
        for (int pose = 0; pose < poses; ++pose)
            all.push_back({{10.0 * (pose - static_cast<int>(poses / 2))}});
        return all;
    }

    LightPictures light(const std::function<bool(glm::dvec2, const glm::dvec3&)>& is_bright) const {
        LightPictures pictures{scene.scene.view.image_px, 1, poses, {}, {}};
        for (int pose = 0; pose < poses; ++pose) {
            for (int y = 0; y < pictures.image_px.y; ++y) {
                for (int x = 0; x < pictures.image_px.x; ++x) {
                    const glm::dvec2 place(x + 0.5, y + 0.5);
                    const auto point = maps.surface_at({pose}, place);
                    pictures.coverage.push_back(point ? 1.0f : 0.0f);
                    pictures.luminance.push_back(!point                                          ? 0.0f
                                                 : is_bright(place, glm::dvec3(point->position)) ? 0.8f
                                                                                                 : 0.1f);
                }
            }
        }
        return pictures;
    }

    /// A fixation of a place of the image while a pose is shown.
    StudyFixation fixation(int pose, glm::dvec2 image_place, bool with_light = true) const {
        const std::array clocks{ClockPair{SessionTime(0s), TrackerTime(0s), SessionTime(0s)},
                                ClockPair{SessionTime(100s), TrackerTime(100s), SessionTime(100s)}};
        const std::optional<ClockMap> clock_map{ClockMap(clocks)};
        const auto point = maps.surface_at({pose}, image_place);
        REQUIRE(point);
        std::vector<PlacedSample> samples;
        for (int i = 0; i < 100; ++i) {
            PlacedSample sample;
            sample.sampled_at = TrackerTime(1s + std::chrono::milliseconds(i));
            sample.frame = pose;
            sample.pose = PoseIndex{pose};
            sample.gaze = screen.screen_from_image(image_place);
            sample.has_gaze = sample.has_time = sample.is_on_surface = true;
            sample.surface = *point;
            samples.push_back(sample);
        }
        GazeEvent event;
        event.kind = GazeEvent::Kind::fixation;
        event.start = samples.front().sampled_at;
        event.end = samples.back().sampled_at;
        event.duration = event.end - event.start;
        const StudyOptions options;
        const std::optional<ObjectScale> scale = ObjectScale{1.0, 1000.0, 30.0};
        ShownPictures pictures; // each pose has a picture and a frame of its own
        for (int one = 0; one < poses; ++one) {
            pictures.poses.push_back({one});
            pictures.seconds.push_back(0.1);
            pictures.of_frame.push_back(one);
        }
        return *surface_fixation(event, {.options = options,
                                         .samples = samples,
                                         .clock_map = clock_map,
                                         .onset = SessionTime(1s),
                                         .presentation_s = 8.0,
                                         .angles = scene.angles,
                                         .scale = scale,
                                         .has_surface = true,
                                         .lookup = &maps,
                                         .screen = &screen,
                                         .light = with_light ? &scores : nullptr,
                                         .pictures = &pictures});
    }

    glm::dvec2 seen(int pose, const glm::dvec3& point) const {
        return glm::dvec2(maps.sight_lines({pose}).project(point));
    }

    CastScene scene;
    CoordinateMaps maps;
    LightScores scores;
    ScreenGeometry screen;
};

constexpr glm::dvec2 highlight(80.0, 80.0);

} // namespace

TEST_CASE("gaze on a highlight that stays on the screen meets more light than its point of the surface has",
          "[unit]") {
    const LitBall ball(
        [](glm::dvec2 place, const glm::dvec3&) { return glm::distance(place, highlight) < 6.0; });
    for (int pose = 0; pose < LitBall::poses; ++pose) {
        const StudyFixation fixation = ball.fixation(pose, highlight);
        REQUIRE(fixation.light);
        CHECK(fixation.light->met > 3.0);
        // But for the outline's pixels, which are others in each pose.
        CHECK(fixation.light->met == Approx(fixation.light->at_place).epsilon(0.002));
        CHECK(fixation.light->met - fixation.light->at_point > 1.0);
    }
    // Beside it: dark now, and brighter whenever the surface has turned beneath the highlight.
    const StudyFixation beside = ball.fixation(LitBall::poses / 2, highlight + glm::dvec2(14.0, 0.0));
    REQUIRE(beside.light);
    CHECK(beside.light->met < 0.0);
    CHECK(beside.light->met == Approx(beside.light->at_place).epsilon(0.002));
    CHECK(beside.light->at_point > beside.light->met + 0.3);
    CHECK_FALSE(ball.fixation(0, highlight, false).light);
}

TEST_CASE("gaze on a painted spot meets more light than its place on the screen has", "[unit]") {
    const LitBall bare([](glm::dvec2, const glm::dvec3&) { return true; });
    CHECK_FALSE(bare.fixation(0, highlight).light); // one light throughout
    const glm::dvec3 spot(bare.maps.surface_at({LitBall::poses / 2}, highlight)->position);
    const LitBall ball([&](glm::dvec2, const glm::dvec3& point) { return glm::distance(point, spot) < 6.0; });
    for (int pose = 0; pose < LitBall::poses; ++pose) {
        const StudyFixation fixation = ball.fixation(pose, ball.seen(pose, spot));
        REQUIRE(fixation.light);
        CHECK(fixation.light->met > 3.0);
        CHECK(fixation.light->met - fixation.light->at_place > 1.0);
        // The spot is foreshortened to the sides, so the object's mean is another in each pose.
        CHECK(fixation.light->met == Approx(fixation.light->at_point).epsilon(0.15));
    }
}

TEST_CASE("gaze that does not mind the light has no more of it than its places, whatever these are",
          "[unit]") {
    // A band on the screen, a spot on the surface and a light at the observer at once: what faces the
    // observer is bright. Gaze falls anywhere on the picture; over places of the screen it may prefer any.
    const LitBall ball([](glm::dvec2 place, const glm::dvec3& point) {
        return std::abs(place.y - 70.0) < 8.0 || glm::distance(place, glm::dvec2(80.0)) < 45.0 ||
               glm::distance(point, glm::dvec3(20.0, -50.0, 20.0)) < 15.0;
    });
    RandomStream random(7, "gaze without regard to light");
    double over_place = 0.0, over_point = 0.0, place_squares = 0.0, point_squares = 0.0;
    int count = 0;
    while (count < 4000) {
        const int pose = static_cast<int>(random.below(LitBall::poses));
        const glm::dvec2 chosen(160.0 * random.uniform(), 160.0 * random.uniform());
        if (!ball.maps.surface_at({pose}, chosen))
            continue;
        const StudyFixation fixation = ball.fixation(pose, chosen);
        if (!fixation.light)
            continue;
        const double place = fixation.light->met - fixation.light->at_place;
        const double at_point = fixation.light->met - fixation.light->at_point;
        over_place += place;
        over_point += at_point;
        place_squares += place * place;
        point_squares += at_point * at_point;
        ++count;
    }
    const auto error = [&](double sum, double squares) {
        const double mean = sum / count;
        return std::sqrt((squares / count - mean * mean) / (count - 1));
    };
    CAPTURE(over_place / count, over_point / count, error(over_point, point_squares));
    CHECK(std::abs(over_place / count) < 4.0 * error(over_place, place_squares));
    CHECK(std::abs(over_point / count) < 4.0 * error(over_point, point_squares));
    CHECK(error(over_place, place_squares) > 0.0);
}

TEST_CASE("an observer's light is the mean over fixations by their duration, the study's over observers",
          "[unit]") {
    PaintedStudy study(3, 2, 4, [](int, int, RandomStream&) { return front; });
    CHECK(lights_at_gaze(study.results, {{"material", {"smooth", "rough"}}}, study.options).empty());
    // In "smooth" gaze is on highlights; of the fourth fixations nothing is known, the third are long.
    for (std::size_t i = 0; i < study.results.fixations.size(); ++i) {
        StudyFixation& fixation = study.results.fixations[i];
        const bool smooth =
            study.results.trials[static_cast<std::size_t>(fixation.trial)].key("material") == "smooth";
        fixation.duration_s = i % 4 == 2 ? 0.6 : 0.3;
        if (i % 4 < 3)
            fixation.light = {smooth ? 1.0 : 0.2, i % 4 == 2 ? 0.6 : 0.0, smooth ? 0.4 : 0.2};
    }
    const auto rows = lights_at_gaze(study.results, {{"material", {"smooth", "rough"}}}, study.options);
    REQUIRE(rows.size() == 3);
    CHECK(rows[0].keys.empty());
    CHECK(rows[0].observers == 3);
    CHECK(rows[0].fixations == 18);
    CHECK(*rows[0].lightness.value == Approx(0.6));
    CHECK(*rows[0].over_place.value == Approx(0.3));
    CHECK(*rows[0].over_point.value == Approx(0.3));
    CHECK(rows[1].keys == std::vector<StudyKey>{{"material", "smooth"}});
    CHECK(*rows[1].lightness.value == Approx(1.0));
    CHECK(*rows[1].over_place.value == Approx(0.7));
    CHECK(*rows[1].over_point.value == Approx(0.6));
    CHECK(*rows[2].lightness.value == Approx(0.2));
    CHECK(*rows[2].over_place.value == Approx(-0.1));
    CHECK(*rows[2].over_point.value == Approx(0.0).margin(1e-12));
    CHECK(rows[2].fixations == 9);
}
