/// A presentation before the first trial: as those to come, but for the observer, who sees none of it.
#include "experiment/session/presentation_check.h"

#include "tests/experiment/record/plain_session.h"

using namespace overt;
using namespace overt::test;
using Catch::Matchers::Contains;

namespace {

/// Keeps the session's thread from the display for a while after one of the flips.
struct Hindrance final : PresentationListener {
    explicit Hindrance(StandingClock& time) : clock(time) {}
    void presentation_begins(const Trial& trial, int) noexcept override { begun.push_back(trial.index); }
    void flipped(const FlipRecord& flip) noexcept override {
        if (flip.refresh_in_trial == at)
            clock.wait_until(clock.now() + std::chrono::microseconds(20'000));
    }
    void screen_shown(const Screen&, SessionTime) noexcept override { ++screens; }
    StandingClock& clock;
    int at = -1;
    int screens = 0;
    std::vector<int> begun;
};

struct DarkPresentation {
    Protocol protocol = short_protocol("");
    StandingClock clock;
    PlainPresenter presenter{clock};
    BlinkingTracker tracker;
    NotingLog log;
    Hindrance hindrance{clock};
    PresentationCheck run() {
        const Schedule schedule = make_schedule(protocol, {"P", 1}, 1);
        PresentationListener* const listeners[] = {&hindrance};
        const CheckedTracker trackers[] = {{tracker, log}};
        return check_presentation(protocol, schedule.trials.front(),
                                  {clock, presenter, log, listeners, trackers});
    }
};

} // namespace

TEST_CASE(
    "a check of the presentation shows the first trial's frames in their order, unseen, with tracker and log",
    "[unit]") {
    DarkPresentation dark;
    const PresentationCheck check = dark.run();
    // 0.1 s at 120 Hz, each frame of 30 a second for four refreshes.
    CHECK(check.refreshes == 12);
    CHECK(check.missed == 0);
    CHECK_FALSE(misses_too_many(check));
    CHECK(dark.presenter.veiled_frames == std::vector<int>{0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2});
    CHECK(dark.presenter.seen_frames.empty());
    CHECK_FALSE(dark.presenter.is_veiled);
    CHECK(dark.log.flips == 12);
    CHECK(dark.log.samples == check.samples);
    CHECK(check.samples == dark.tracker.arrived);
    CHECK(dark.hindrance.begun == std::vector<int>{0});
    CHECK(dark.hindrance.screens == 1);
    REQUIRE(check.intervals_ms.size() == 11);
    for (const double interval_ms : check.intervals_ms)
        CHECK(interval_ms == Approx(1e3 / 120.0).epsilon(1e-6));
    CHECK(check.work_ms == std::vector<double>(12, 0.0));
}

TEST_CASE("a longer presentation is checked for one period of its frames", "[unit]") {
    DarkPresentation dark;
    dark.protocol.motions.front().duration_s = 8.0;
    const int period = dark.protocol.motions.front().steps_per_period();
    CHECK(dark.run().refreshes == 4 * period);
}

TEST_CASE("what a check of the presentation misses is counted and told with its distribution", "[unit]") {
    DarkPresentation dark;
    dark.hindrance.at = 5;
    const PresentationCheck check = dark.run();
    CHECK(check.missed == 2);
    CHECK(misses_too_many(check));
    CHECK(*std::ranges::max_element(check.intervals_ms) == Approx(3e3 / 120.0).epsilon(1e-6));
    CHECK_THAT(describe(check),
               Contains("10 refreshes, 2 missed") && Contains("median 8.333") && Contains("most 25.000"));
}

TEST_CASE("a tracker that does not record is told, and the rest is checked without it", "[unit]") {
    DarkPresentation dark;
    dark.tracker.fails_at = BlinkingTracker::Step::start;
    const PresentationCheck check = dark.run();
    CHECK(check.refreshes == 12);
    CHECK_THAT(describe(check), Contains("without the eye tracker: it is gone"));
}
