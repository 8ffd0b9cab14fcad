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

TEST_CASE("the distribution of times is that of their ranks", "[unit]") {
    PresentationCheck check;
    for (int i = 100; i >= 0; --i) { // in any order
        check.intervals_ms.push_back(i);
        check.work_ms.push_back(0.001 * i);
    }
    const std::string said = describe(check);
    CHECK_THAT(said,
               Contains("from picture to picture in ms: least 0.000, 1 % 1.000, 5 % 5.000, 25 % 25.000, "
                        "median 50.000, 75 % 75.000, 95 % 95.000, 99 % 99.000, most 100.000;"));
    CHECK_THAT(said, Contains("swap in ms: least 0.000, 1 % 0.001, 5 % 0.005"));
    check.intervals_ms.clear();
    CHECK_THAT(describe(check), Contains("in ms: none;"));
}

TEST_CASE("one miss in a hundred refreshes is tolerable, more is not", "[unit]") {
    PresentationCheck check;
    check.refreshes = 198;
    check.missed = 2;
    CHECK_FALSE(misses_too_many(check));
    check.refreshes = 197;
    CHECK(misses_too_many(check));
    check.missed = 0;
    CHECK_FALSE(misses_too_many(check));
}

TEST_CASE("a check says what it counted, and where nothing proves the times", "[unit]") {
    PresentationCheck check;
    check.refreshes = 1;
    check.missed = 3;
    check.samples = 1;
    CHECK(counts_of(check) == "1 refresh, 3 missed, 1 sample of gaze");
    check.has_proven_times = false;
    CHECK(counts_of(check) ==
          "1 refresh, 3 refreshes missed, by times that nothing proves, 1 sample of gaze");
}

TEST_CASE("a check of the presentation tells each part that it is one, in its order", "[unit]") {
    DarkPresentation dark;
    dark.tracker.late = 5;
    const Schedule schedule = make_schedule(dark.protocol, {"P", 1}, 1);
    PresentationListener* const listeners[] = {&dark.hindrance};
    const CheckedTracker trackers[] = {{dark.tracker, dark.log}};
    PresentationCheckPorts ports{dark.clock, dark.presenter, dark.log, listeners, trackers};
    ports.has_proven_times = false;
    const PresentationCheck check = check_presentation(dark.protocol, schedule.trials.front(), ports);
    CHECK_FALSE(check.has_proven_times);
    CHECK(dark.log.started == std::vector<int>{schedule.trials.front().index});
    CHECK(dark.presenter.loaded == std::vector<Stimulus>{schedule.trials.front().stimulus});
    // What came when the recording had ended is counted, too.
    CHECK(check.samples == dark.tracker.arrived);
    CHECK(check.samples >= 12 + 5);
    // The veil comes before the first dark screen and goes before the last.
    CHECK(dark.presenter.blanks == 3);
    CHECK(dark.presenter.veiled_blanks == 2);
}
