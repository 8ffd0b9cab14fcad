/// Fixations placed on a surface from samples whose places are known.
#include "experiment/study/fixations/surface_fixations.h"

#include <array>
#include <cmath>

#include <catch2/catch.hpp>

using namespace overt;
using namespace std::chrono_literals;

namespace {

/// Both clocks agree, and the presentation began a second after their zero.
const ClockMap& clocks() {
    static const ClockMap map(std::array{ClockPair{SessionTime(0s), TrackerTime(0s), SessionTime(0s)},
                                         ClockPair{SessionTime(100s), TrackerTime(100s), SessionTime(100s)}});
    return map;
}

/// A trial of 8 s with a sample each millisecond, all of them on one place of part 0 at depth 1000.
struct PlacedTrial {
    PlacedTrial() {
        for (int i = 0; i < 8000; ++i) {
            PlacedSample sample;
            sample.sampled_at = TrackerTime(1s + std::chrono::milliseconds(i));
            sample.gaze = {500.0, 400.0};
            sample.has_gaze = sample.has_time = true;
            sample.frame = i / 100;
            sample.pose = PoseIndex{(i / 100) % 3};
            sample.is_on_surface = true;
            sample.surface.position = {1.0, 2.0, 3.0};
            sample.surface.triangle = 7;
            sample.surface.barycentric = {0.2, 0.3, 0.5};
            sample.surface.depth = 1000.0;
            samples.push_back(sample);
        }
    }
    /// From one millisecond after the onset to another.
    std::optional<StudyFixation> fixation(int from_ms, int to_ms) const {
        GazeEvent event;
        event.kind = GazeEvent::Kind::fixation;
        event.start = TrackerTime(1s + std::chrono::milliseconds(from_ms));
        event.end = TrackerTime(1s + std::chrono::milliseconds(to_ms));
        event.duration = event.end - event.start;
        return surface_fixation(event, {.options = options,
                                        .samples = samples,
                                        .clock_map = clock_map,
                                        .onset = SessionTime(1s),
                                        .presentation_s = 8.0,
                                        .angles = angles,
                                        .scale = scale,
                                        .has_surface = true});
    }

    std::vector<PlacedSample> samples;
    StudyOptions options;
    std::optional<ClockMap> clock_map = clocks();
    std::vector<ObjectPose> angles{{-10.0}, {0.0}, {10.0}};
    /// A unit of the mesh is half a millimetre, and 30 mm a degree in the axis' depth.
    std::optional<ObjectScale> scale = ObjectScale{0.5, 1000.0, 30.0};
};

} // namespace

TEST_CASE("a fixation has the time, frames, pose and place of its own samples", "[unit]") {
    PlacedTrial trial;
    for (int i = 250; i <= 449; ++i)
        trial.samples[static_cast<std::size_t>(i)].gaze = {510.0 + i % 2, 390.0};
    const auto fixation = trial.fixation(250, 449);
    REQUIRE(fixation);
    CHECK(fixation->counted());
    CHECK(fixation->onset_s == Approx(0.25).margin(1e-5));
    CHECK(fixation->duration_s == Approx(0.199).margin(1e-5));
    CHECK(fixation->samples == 200);
    CHECK(fixation->place.x_px == Approx(510.5));
    CHECK(fixation->place.y_px == Approx(390.0));
    CHECK(fixation->first_frame == 2);
    CHECK(fixation->last_frame == 4);
    CHECK(fixation->mid_pose == PoseIndex{0}); // sample 350: frame 3
    CHECK(fixation->mid_angle_deg == -10.0);
    CHECK(fixation->on_surface == 1.0);
    CHECK(fixation->within_reach == 0.0);
    CHECK_FALSE(fixation->only_by_reach);
}

TEST_CASE("what lies outside of the presentation is left out, or cut", "[unit]") {
    const PlacedTrial trial;
    CHECK_FALSE(trial.fixation(-300, -10));
    CHECK_FALSE(trial.fixation(8010, 8200));
    const auto early = trial.fixation(-50, 100);
    REQUIRE(early);
    CHECK(early->why == NotCounted::began_before_onset);
    const auto late = trial.fixation(7800, 8300);
    REQUIRE(late);
    CHECK(late->counted());
    CHECK(late->duration_s == Approx(0.2).margin(1e-5));
}

TEST_CASE("the spread is the root mean square distance from the place, in millimetres and degrees",
          "[unit]") {
    PlacedTrial trial;
    // Nine samples at the middle, one each 6 units to either side: squares of 36 over 11 samples.
    for (int i = 100; i <= 110; ++i) {
        PlacedSample& sample = trial.samples[static_cast<std::size_t>(i)];
        sample.surface.depth = 1200.0;
        sample.surface.position.x = i == 100 ? -5.0 : i == 110 ? 7.0 : 1.0;
    }
    const auto fixation = trial.fixation(100, 110);
    REQUIRE(fixation);
    CHECK(fixation->position == glm::dvec3(1.0, 2.0, 3.0));
    const double spread_mm = 0.5 * std::sqrt(72.0 / 11.0);
    CHECK(*fixation->spread_mm == Approx(spread_mm));
    // What is a fifth farther away has a fifth more millimetres to a degree.
    CHECK(*fixation->spread_deg == Approx(spread_mm / (30.0 * 1.2)));
    CHECK(fixation->mm_per_deg == Approx(36.0));
}

TEST_CASE("a fixation's part is that of most of its samples", "[unit]") {
    PlacedTrial trial;
    for (int i = 100; i <= 110; ++i)
        trial.samples[static_cast<std::size_t>(i)].surface.part = i < 106 ? PartIndex{2} : PartIndex{1};
    CHECK(trial.fixation(100, 110)->part == PartIndex{2});
    CHECK(trial.fixation(104, 110)->part == PartIndex{1});
    CHECK(trial.fixation(300, 310)->part == PartIndex{0});
}

TEST_CASE("samples beside the object count within the reach alone, and lost ones not at all", "[unit]") {
    PlacedTrial trial;
    for (int i = 100; i < 120; ++i) {
        PlacedSample& sample = trial.samples[static_cast<std::size_t>(i)];
        sample.is_on_surface = i < 108;
        sample.is_within_reach = i >= 108 && i < 112;
    }
    const auto by_reach = trial.fixation(100, 119);
    REQUIRE(by_reach);
    CHECK(by_reach->on_surface == Approx(0.4));
    CHECK(by_reach->within_reach == Approx(0.2));
    CHECK(by_reach->counted()); // 0.6 of the samples, of which the surface alone gives 0.4
    CHECK(by_reach->only_by_reach);
    trial.options.least_on_surface = 0.7;
    CHECK(trial.fixation(100, 119)->why == NotCounted::not_on_surface);
    // Without the twelve that missed it, all that are left meet it.
    for (int i = 108; i < 120; ++i)
        trial.samples[static_cast<std::size_t>(i)].has_gaze = false;
    CHECK(trial.fixation(100, 119)->on_surface == 1.0);
    CHECK(trial.fixation(100, 119)->samples == 8);
}

TEST_CASE("why a fixation is not counted is told by the first rule that it breaks", "[unit]") {
    PlacedTrial trial;
    trial.options.shortest_fixation_s = 0.1;
    CHECK(trial.fixation(100, 180)->why == NotCounted::too_short);
    CHECK(trial.fixation(100, 210)->counted());
    for (PlacedSample& sample : trial.samples)
        sample.frame = -1;
    CHECK(trial.fixation(100, 210)->why == NotCounted::no_frame_lit);
    trial.clock_map.reset();
    CHECK(trial.fixation(100, 210)->why == NotCounted::no_frame_lit);
}

TEST_CASE("samples of a stretch are those at both its ends and between", "[unit]") {
    const PlacedTrial trial;
    const auto between = [&](int from_us, int to_us) {
        const auto [begin, end] =
            samples_between(trial.samples, TrackerTime(1s + std::chrono::microseconds(from_us)),
                            TrackerTime(1s + std::chrono::microseconds(to_us)));
        return std::pair(static_cast<int>(begin), static_cast<int>(end));
    };
    CHECK(between(5000, 9000) == std::pair(5, 10));
    CHECK(between(5001, 8999) == std::pair(6, 9));
    CHECK(between(-5000, 500) == std::pair(0, 1));
    CHECK(between(9'000'000, 9'500'000) == std::pair(8000, 8000));
}
