/// A presentation before the first trial: as those to come, but for the observer, who sees none of it.
#include "experiment/session/presentation_rehearsal.h"

#include "tests/experiment/record/plain_session.h"

using namespace overt;
using namespace overt::test;
using Catch::Matchers::Contains;

namespace {

/// Keeps the session's thread from the display for a while after one of the flips.
struct Hindrance final : PresentationListener {
    explicit Hindrance(StandingClock& time) : clock(time) {}
    void presentation_begins(const Trial& trial) noexcept override { begun.push_back(trial.index); }
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

struct Rehearsal {
    Protocol protocol = short_protocol("");
    StandingClock clock;
    PlainPresenter presenter{clock};
    BlinkingTracker tracker;
    NotingLog log;
    Hindrance hindrance{clock};
    RehearsedPresentation run() {
        const Schedule schedule = make_schedule(protocol, {"P", 1}, 1);
        PresentationListener* const listeners[] = {&hindrance};
        const RehearsedTracker trackers[] = {{tracker, log}};
        return rehearse_presentation(protocol, schedule.trials.front(),
                                     {clock, presenter, log, listeners, trackers});
    }
};

} // namespace

TEST_CASE("a rehearsal shows the first trial's frames in their order, unseen, with tracker and log",
          "[unit]") {
    Rehearsal rehearsal;
    const RehearsedPresentation rehearsed = rehearsal.run();
    // 0.1 s at 120 Hz, each frame of 30 a second for four refreshes.
    CHECK(rehearsed.refreshes == 12);
    CHECK(rehearsed.missed == 0);
    CHECK_FALSE(misses_too_many(rehearsed));
    CHECK(rehearsal.presenter.veiled_frames == std::vector<int>{0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2});
    CHECK(rehearsal.presenter.seen_frames.empty());
    CHECK_FALSE(rehearsal.presenter.is_veiled);
    CHECK(rehearsal.log.flips == 12);
    CHECK(rehearsal.log.samples == rehearsed.samples);
    CHECK(rehearsed.samples == rehearsal.tracker.arrived);
    CHECK(rehearsal.hindrance.begun == std::vector<int>{0});
    CHECK(rehearsal.hindrance.screens == 1);
    REQUIRE(rehearsed.intervals_ms.size() == 11);
    for (const double interval_ms : rehearsed.intervals_ms)
        CHECK(interval_ms == Approx(1e3 / 120.0).epsilon(1e-6));
    CHECK(rehearsed.work_ms == std::vector<double>(12, 0.0));
}

TEST_CASE("a longer presentation is rehearsed for one period of its frames", "[unit]") {
    Rehearsal rehearsal;
    rehearsal.protocol.animation.duration_s = 8.0;
    const int period = rehearsal.protocol.animation.steps_per_period();
    CHECK(rehearsal.run().refreshes == 4 * period);
}

TEST_CASE("what a rehearsal misses is counted and told with its distribution", "[unit]") {
    Rehearsal rehearsal;
    rehearsal.hindrance.at = 5;
    const RehearsedPresentation rehearsed = rehearsal.run();
    CHECK(rehearsed.missed == 2);
    CHECK(misses_too_many(rehearsed));
    CHECK(*std::ranges::max_element(rehearsed.intervals_ms) == Approx(3e3 / 120.0).epsilon(1e-6));
    CHECK_THAT(describe(rehearsed),
               Contains("10 refreshes, 2 missed") && Contains("median 8.333") && Contains("most 25.000"));
}

TEST_CASE("a tracker that does not record is told, and the rest is rehearsed without it", "[unit]") {
    Rehearsal rehearsal;
    rehearsal.tracker.fails_at = BlinkingTracker::Step::start;
    const RehearsedPresentation rehearsed = rehearsal.run();
    CHECK(rehearsed.refreshes == 12);
    CHECK_THAT(describe(rehearsed), Contains("without the eye tracker: it is gone"));
}
