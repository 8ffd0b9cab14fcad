/// Fixations that are found while samples pass by, against those found with all samples at hand.
#include "experiment/study/fixations/passing_fixations.h"

#include <algorithm>
#include <array>

#include <catch2/catch.hpp>

#include "experiment/base/random.h"

using namespace overt;
using namespace std::chrono_literals;

namespace {

/// Both clocks agree, and the presentation began a second after their zero.
const ClockMap& clocks_of_passing() {
    static const ClockMap map(std::array{ClockPair{SessionTime(0s), TrackerTime(0s), SessionTime(0s)},
                                         ClockPair{SessionTime(100s), TrackerTime(100s), SessionTime(100s)}});
    return map;
}

/// Samples of both eyes that wander over two parts and off the surface, each eye with its own gaps.
std::array<std::vector<PlacedSample>, 2> wandering(RandomStream& random) {
    std::array<std::vector<PlacedSample>, 2> of_eye;
    for (std::vector<PlacedSample>& samples : of_eye) {
        for (int i = 0; i < 4000; ++i) {
            if (random.uniform() < 0.02)
                continue;
            PlacedSample& sample = samples.emplace_back();
            sample.sampled_at = TrackerTime(800ms + std::chrono::milliseconds(i));
            sample.has_gaze = random.uniform() < 0.9;
            sample.gaze = {random.uniform() * 500.0, random.uniform() * 400.0};
            sample.frame = i < 200 ? -1 : i / 100;
            sample.pose = PoseIndex{i / 100 % 3};
            const bool is_beside = i < 200 || (i > 1500 && i < 2400);
            sample.is_on_surface = sample.has_gaze && !is_beside && random.uniform() < 0.7;
            sample.surface.position = {random.normal(), random.normal(), random.normal()};
            sample.surface.part = random.uniform() < 0.5 ? PartIndex{0} : PartIndex{1};
            sample.surface.depth = 1000.0;
        }
    }
    return of_eye;
}

/// Some within each other, some that share an end, some before and after the presentation.
std::vector<GazeEvent> many_events(RandomStream& random) {
    std::vector<GazeEvent> events;
    for (int i = 0; i < 60; ++i) {
        GazeEvent& event = events.emplace_back();
        event.kind = i % 7 == 6 ? GazeEvent::Kind::saccade : GazeEvent::Kind::fixation;
        if (i % 5 != 0)
            event.eye = random.uniform() < 0.5 ? Eye::left : Eye::right;
        event.start = TrackerTime(std::chrono::milliseconds(static_cast<int>(random.uniform() * 5000.0)));
        event.end = event.start + std::chrono::milliseconds(static_cast<int>(random.uniform() * 900.0));
        event.duration = event.end - event.start;
    }
    return events;
}

} // namespace

TEST_CASE("fixations that are found while samples pass by are those of all samples together", "[unit]") {
    const StudyOptions options;
    const std::optional<ClockMap> clock_map = clocks_of_passing();
    const std::vector<ObjectPose> angles{{-10.0}, {0.0}, {10.0}};
    const std::optional<ObjectScale> scale = ObjectScale{0.5, 1000.0, 30.0};
    int with_place = 0, without = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        RandomStream random(seed, "passing fixations");
        const auto of_eye = wandering(random);
        const std::vector<GazeEvent> events = many_events(random);
        FixationContext context{.options = options,
                                .samples = {},
                                .clock_map = clock_map,
                                .onset = SessionTime(1s),
                                .presentation_s = 3.0,
                                .angles = angles,
                                .scale = scale,
                                .has_surface = true};
        PassingFixations passing(context, events, Eye::right, Degrees{0.0});
        std::array<std::size_t, 2> next{0, 0};
        while (next[0] < of_eye[0].size() || next[1] < of_eye[1].size()) {
            // The eyes' samples come mixed, each in the order of time.
            const std::size_t eye = next[0] == of_eye[0].size()                                     ? 1
                                    : next[1] == of_eye[1].size()                                   ? 0
                                    : of_eye[1][next[1]].sampled_at < of_eye[0][next[0]].sampled_at ? 1
                                                                                                    : 0;
            passing.take(static_cast<Eye>(eye), of_eye[eye][next[eye]++]);
        }
        const auto found = passing.finish();
        REQUIRE(found.size() == events.size());
        for (std::size_t i = 0; i < events.size(); ++i) {
            CAPTURE(seed, i);
            context.samples = of_eye[static_cast<std::size_t>(events[i].eye.value_or(Eye::right))];
            const auto expected = events[i].kind == GazeEvent::Kind::fixation
                                      ? surface_fixation(events[i], context)
                                      : std::nullopt;
            REQUIRE(found[i].has_value() == expected.has_value());
            if (!expected)
                continue;
            CHECK(found[i]->position == expected->position);
            CHECK(found[i]->part == expected->part);
            CHECK(found[i]->samples == expected->samples);
            CHECK(found[i]->on_surface == expected->on_surface);
            CHECK(found[i]->why == expected->why);
            (expected->part ? with_place : without) += 1;
        }
    }
    CHECK(with_place > 200);
    CHECK(without > 20);
}
