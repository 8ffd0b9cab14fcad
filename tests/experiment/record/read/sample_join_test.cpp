#include "experiment/record/read/sample_join.h"

#include <cmath>

#include <catch2/catch.hpp>

#include "experiment/base/random.h"
#include "tests/support/cast_maps.h"
#include "tests/support/motion_of.h"

using namespace overt;
using test::CastScene;

namespace {

constexpr SessionDuration refresh_interval = std::chrono::milliseconds(10);
const SessionTime onset(std::chrono::seconds(1));
constexpr glm::ivec2 image_px{200, 200};

ScreenGeometry screen() {
    ScreenGeometry screen;
    screen.screen_px = {400, 300};
    screen.screen_mm = {300.0, 240.0}; // pixels are higher than wide
    screen.viewing_distance_mm = 400.0;
    screen.image_px = image_px;
    screen.image_origin_px = {110, 40};
    return screen;
}

/// A ledger in which each refresh has a chance to be missed, and the samples of two and a half seconds.
struct Presentation {
    PageCycle plan = make_page_cycle(motion_of(5, 20.0, 2.0), 100.0);
    ScanOut scan_out{std::chrono::microseconds(1700), 100.0, 300.0};
    std::vector<FlipRecord> flips;
    std::vector<GazeSample> samples;

    Presentation(std::uint64_t seed, std::uint32_t missed_of_100) {
        RandomStream random(seed, "presentation");
        for (int refresh = 0; refresh < plan.total_refreshes; ++refresh) {
            const PageCycleEntry& entry = plan.entry_at(refresh);
            while (refresh > 0 && random.below(100) < missed_of_100)
                ++refresh;
            FlipRecord flip{0, refresh, entry.frame, entry.frame, entry.pose, {}};
            flip.report.refresh = {refresh};
            flip.report.vertical_blank = onset + refresh * refresh_interval;
            flips.push_back(flip);
        }
        for (int i = 0; i < 5000; ++i) {
            GazeSample sample;
            sample.sampled_at = TrackerTime(std::chrono::microseconds(900'000 + 500 * i + 123));
            if (random.below(20) != 0)
                sample.gaze = ScreenPoint{random.uniform(-20.0, 420.0), random.uniform(-20.0, 320.0)};
            samples.push_back(sample);
        }
    }

    SampleJoin join(const SurfaceLookup* lookup) const {
        // Both clocks are one.
        const std::vector<ClockPair> pairs{{SessionTime{}, TrackerTime{}, SessionTime{}},
                                           {SessionTime(std::chrono::seconds(9)),
                                            TrackerTime(std::chrono::seconds(9)),
                                            SessionTime(std::chrono::seconds(9))}};
        return {screen(), ClockMap(pairs), FlipHistory(flips, scan_out, plan), lookup};
    }

    /// Frame by ledger and by plan at a sample's time, found by going through them; -1: none.
    struct Frames {
        int lit = -1, planned = -1;
    };
    Frames frames_at(const GazeSample& sample) const {
        const double row_share = std::min(1.0, std::max(0.0, sample.gaze->y_px / 300.0));
        const double since_ms = 1e-3 * static_cast<double>(sample.sampled_at.time_since_epoch().count()) -
                                1000.0 - 1.7 - 10.0 * row_share;
        Frames frames;
        for (std::size_t i = 0; i < flips.size(); ++i) {
            const double from_ms = 10.0 * flips[i].refresh_in_trial;
            const double until_ms =
                i + 1 < flips.size() ? 10.0 * flips[i + 1].refresh_in_trial : from_ms + 10.0;
            if (since_ms >= from_ms && since_ms < until_ms)
                frames.lit = flips[i].shown.value;
        }
        if (since_ms >= 0.0 && since_ms < 10.0 * plan.total_refreshes)
            frames.planned = plan.entry_at(static_cast<int>(since_ms / 10.0)).frame.value;
        return frames;
    }
};

/// A ball whose picture has an outline that can be computed.
CastScene one_ball() {
    return CastScene(test::ball({0.0, 0.0, 0.0}, 50.0, 90, 180), {{0.0}, {12.0}, {-12.0}}, image_px, 0.2);
}

} // namespace

TEST_CASE("the samples that the plan puts on another frame are counted exactly, whatever was missed",
          "[unit]") {
    for (const std::uint32_t missed_of_100 : {0u, 1u, 10u, 40u}) {
        const Presentation presentation(3 + missed_of_100, missed_of_100);
        std::vector<JoinedSample> joined(presentation.samples.size());
        presentation.join(nullptr).join(presentation.samples, joined);
        int off_plan = 0, expected = 0;
        for (std::size_t i = 0; i < joined.size(); ++i) {
            off_plan += joined[i].off_plan;
            if (!presentation.samples[i].gaze)
                continue;
            const auto frames = presentation.frames_at(presentation.samples[i]);
            expected += frames.lit != frames.planned;
            REQUIRE((joined[i].shown ? joined[i].shown->frame.value : -1) == frames.lit);
        }
        CHECK(off_plan == expected);
        // One miss in the middle of a frame's time changes nothing that is seen.
        if (missed_of_100 != 1)
            CHECK((expected > 0) == (missed_of_100 > 0));
    }
}

TEST_CASE("nothing of the samples before is left in rows that are used again", "[unit]") {
    const Presentation presentation(43, 40);
    const CastScene ball = one_ball();
    const CoordinateMaps maps = ball.maps();
    const SampleJoin join = presentation.join(&maps);
    std::vector<JoinedSample> fresh(presentation.samples.size()), used(presentation.samples.size());
    join.join(presentation.samples, fresh);
    std::vector<GazeSample> reversed(presentation.samples.rbegin(), presentation.samples.rend());
    join.join(reversed, used);
    join.join(presentation.samples, used);
    int off_plan = 0;
    for (std::size_t i = 0; i < fresh.size(); ++i) {
        off_plan += fresh[i].off_plan;
        REQUIRE(used[i].off_plan == fresh[i].off_plan);
        REQUIRE(used[i].at.has_value() == fresh[i].at.has_value());
        REQUIRE(used[i].image_px == fresh[i].image_px);
        REQUIRE(used[i].shown.has_value() == fresh[i].shown.has_value());
        REQUIRE(used[i].sight.surface.has_value() == fresh[i].sight.surface.has_value());
        REQUIRE(used[i].sight.outline_px == fresh[i].sight.outline_px);
        REQUIRE(used[i].outline_distance.has_value() == fresh[i].outline_distance.has_value());
    }
    CHECK(off_plan > 100);
}

TEST_CASE("a joined sample has the surface of the frame that was lit", "[unit]") {
    const CastScene balls(test::two_balls(), {{0.0}, {25.0}, {-25.0}}, image_px);
    const CoordinateMaps maps = balls.maps();
    Presentation presentation(1, 5);
    std::vector<JoinedSample> joined(presentation.samples.size());
    presentation.join(&maps).join(presentation.samples, joined);
    int on_object = 0;
    for (std::size_t i = 0; i < joined.size(); ++i) {
        const GazeSample& sample = presentation.samples[i];
        REQUIRE(joined[i].image_px.has_value() == sample.gaze.has_value());
        if (!joined[i].shown) {
            CHECK_FALSE(joined[i].sight.surface);
            CHECK_FALSE(joined[i].outline_distance);
            continue;
        }
        const glm::dvec2 place(sample.gaze->x_px - 110.0, sample.gaze->y_px - 40.0);
        CHECK(*joined[i].image_px == place);
        const auto hit = balls.hit(joined[i].shown->pose, place);
        const bool inside = screen().is_inside_image(place);
        REQUIRE(joined[i].sight.surface.has_value() == (inside && hit));
        if (joined[i].sight.surface) {
            ++on_object;
            CHECK(glm::distance(joined[i].sight.surface->position, hit->position) < 1e-6);
        }
        CHECK(joined[i].outline_distance.has_value());
    }
    CHECK(on_object > 300);
}

TEST_CASE("the distance to the silhouette is the visual angle to the nearest place of a ball's outline",
          "[unit]") {
    const CastScene ball = one_ball();
    const CoordinateMaps maps = ball.maps();
    const Presentation presentation(2, 0);
    std::vector<JoinedSample> joined(presentation.samples.size());
    presentation.join(&maps).join(presentation.samples, joined);
    // The outline: where lines of sight touch the ball, at the angle whose sine is radius / distance.
    const View& view = ball.scene.view;
    const double distance = glm::length(view.camera.position);
    std::vector<glm::dvec2> outline;
    const double touch = std::asin(50.0 / distance);
    for (int i = 0; i < 3600; ++i) {
        const double turn = to_radians({0.1 * i}).value;
        // The camera looks along +y at the middle of the ball.
        const glm::dvec3 sight(std::sin(touch) * std::cos(turn), std::cos(touch),
                               std::sin(touch) * std::sin(turn));
        outline.push_back(view.project(view.camera.position + distance * sight));
    }
    int beside = 0, on = 0, beyond_image = 0;
    for (std::size_t i = 0; i < joined.size(); i += 5) {
        if (!joined[i].outline_distance)
            continue;
        double least_deg = 1e9;
        for (const glm::dvec2& place : outline)
            least_deg = std::min(least_deg, screen()
                                                .angle_between(*presentation.samples[i].gaze,
                                                               screen().screen_from_image(place))
                                                .value);
        const bool is_on = joined[i].sight.surface.has_value();
        const double signed_deg = is_on ? -least_deg : least_deg;
        // The diagonal of a pixel, seen head-on, is 0.16 degrees here.
        CHECK(joined[i].outline_distance->value == Approx(signed_deg).margin(0.16));
        on += is_on;
        beside += !is_on;
        beyond_image += !screen().is_inside_image(*joined[i].image_px);
    }
    CHECK(on > 50);
    CHECK(beside > 100);
    CHECK(beyond_image > 50);
}
