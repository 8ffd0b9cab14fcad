/// How much of its gaze a recording gave, and what is made of that.
#include "experiment/ports/gaze_yield.h"

#include <catch2/catch.hpp>

#include "tests/experiment/record/plain_session.h"

using namespace overt;
using namespace overt::test;

namespace {

constexpr double rate_hz = 500.0;

/// Samples of one eye from one time to another, s; `blind`: none of them with gaze.
void give(GazeYieldCount& count, double from_s, double to_s, Eye eye = Eye::right, bool blind = false) {
    for (int i = 0; from_s + i / rate_hz < to_s; ++i) {
        GazeSample sample{.sampled_at = TrackerTime(
                              std::chrono::microseconds(std::llround(1e6 * (100.0 + from_s + i / rate_hz)))),
                          .eye = eye,
                          .gaze = {}};
        if (!blind)
            sample.gaze = ScreenPoint{1.0, 2.0};
        count.take(sample);
    }
}

GazeYieldCount begun(bool both_eyes = false) {
    GazeYieldCount count;
    count.begin(rate_hz, both_eyes ? 2 : 1);
    return count;
}

constexpr SessionDuration eight_seconds = std::chrono::seconds(8);

} // namespace

TEST_CASE("all that comes is all there should be, but for what a tracker needs to begin", "[unit]") {
    GazeYieldCount count = begun();
    give(count, 0.2, 8.0);
    const GazeYield gaze = count.ended_after(eight_seconds);
    CHECK(gaze.missing == 0);
    CHECK(gaze.share() == 1.0);
}

TEST_CASE("what no eye was found in, what never came, and what came of one eye alone is missing", "[unit]") {
    SECTION("no eye") {
        GazeYieldCount count = begun();
        give(count, 0.0, 2.0);
        give(count, 2.0, 8.0, Eye::right, true);
        CHECK(count.ended_after(eight_seconds).share() == Approx(0.25));
        CHECK(count.ended_after(eight_seconds).missing == 0);
    }
    SECTION("a gap") {
        GazeYieldCount count = begun();
        give(count, 0.0, 1.0);
        give(count, 7.0, 8.0);
        CHECK(count.ended_after(eight_seconds).missing == Approx(3000).margin(2));
        CHECK(count.ended_after(eight_seconds).share() == Approx(0.25).margin(0.001));
    }
    SECTION("an end that comes early") {
        GazeYieldCount count = begun();
        give(count, 0.0, 2.0);
        CHECK(count.ended_after(eight_seconds).share() == Approx(0.25).margin(0.001));
    }
    SECTION("nothing at all") {
        GazeYieldCount count = begun();
        CHECK(count.ended_after(eight_seconds).missing == 4000);
        CHECK(count.ended_after(eight_seconds).share() == 0.0);
    }
    SECTION("one of two eyes") {
        GazeYieldCount count = begun(true);
        give(count, 0.0, 8.0);
        CHECK(count.ended_after(eight_seconds).share() == Approx(0.5).margin(0.001));
    }
    SECTION("a rate that is not known") {
        GazeYieldCount count;
        count.begin(0.0, 1);
        CHECK(count.ended_after(eight_seconds).share() == 0.0);
        give(count, 0.0, 1.0);
        CHECK(count.ended_after(eight_seconds).share() == 1.0);
    }
}

TEST_CASE("an attempt without gaze counts where the protocol repeats none for it, and says what it lacks",
          "[unit]") {
    Sitting sitting(short_protocol(""));
    sitting.tracker.blind = {0};
    CHECK(sitting.run().completed_trials == 2);
    REQUIRE(sitting.log.outcomes.size() == 2);
    CHECK(sitting.log.completed[0]);
    CHECK(sitting.log.outcomes[0].failure == "gaze lost");
    CHECK(sitting.log.outcomes[1].failure.empty());
    REQUIRE(sitting.log.outcomes[0].gaze);
    CHECK(sitting.log.outcomes[0].gaze->share() == 0.0);
    CHECK(sitting.log.outcomes[1].gaze->share() == 1.0);
    // The record of the tracker has the same.
    REQUIRE(sitting.log.yields.size() == 2);
    CHECK(sitting.log.yields[0] == *sitting.log.outcomes[0].gaze);
    const auto said = sitting.log.details_of("trial failed");
    REQUIRE(said.size() == 1);
    CHECK_THAT(said[0], Catch::Contains("gaze lost") && Catch::Contains("counts as it is"));

    Sitting repeated(short_protocol("[repeat]\ngaze_lost = \"now\"\n"));
    repeated.tracker.blind = {0};
    CHECK(repeated.run().completed_trials == 2);
    CHECK(repeated.log.completed == std::vector<bool>{false, true, true});

    // Without a tracker there is nothing to lack.
    Sitting without(short_protocol(""));
    without.tracker.is_there = false;
    without.run();
    REQUIRE(without.log.outcomes.size() == 2);
    CHECK(without.log.outcomes[0].failure.empty());
    CHECK_FALSE(without.log.outcomes[0].gaze);
}
