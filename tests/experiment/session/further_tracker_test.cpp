/// Sessions with several eye trackers: what each record holds, and what becomes of a further tracker that
/// fails.
#include <catch2/catch.hpp>

#include "tests/experiment/record/plain_session.h"

using namespace overt;
using namespace overt::test;
using Catch::Matchers::Contains;
using Pressed = ResponsePress::Key;
using Step = BlinkingTracker::Step;

namespace {

struct SittingOfTwo : Sitting {
    explicit SittingOfTwo(std::string_view more = "") : Sitting(short_protocol(more)) {
        further.push_back({"second", second, second_log});
    }
    BlinkingTracker second;
    NotingLog second_log;
};

/// Answers the operator's questions with no; all of them, or those with this text.
void decline(Sitting& sitting, const std::string& about = {}) {
    sitting.panel.tell = [&sitting, about](ScriptedPanel& panel) -> std::optional<ResponsePress> {
        if (!panel.is_deciding() || sitting.presenter.texts.back().find(about) == std::string::npos)
            return std::nullopt;
        return ResponsePress{Pressed::no, {}};
    };
}

} // namespace

TEST_CASE("each of two trackers is set up, marked and recorded; drift is checked with the first alone",
          "[unit]") {
    SittingOfTwo sitting;
    CHECK(sitting.run().completed_trials == 2);
    CHECK(sitting.tracker.calibrations == 1);
    CHECK(sitting.second.calibrations == 1);
    CHECK(sitting.tracker.drift_checks == 2);
    CHECK(sitting.second.drift_checks == 0);
    CHECK(sitting.second.marks == sitting.tracker.marks);
    CHECK(sitting.log.samples == sitting.tracker.arrived);
    CHECK(sitting.second_log.samples == sitting.second.arrived);
    CHECK(sitting.second.arrived > 0);
    // What was shown and answered is in both.
    CHECK(sitting.second_log.flips == sitting.log.flips);
    CHECK(sitting.second_log.started == sitting.log.started);
    CHECK(sitting.second_log.outcomes.size() == 2);
    CHECK(sitting.second_log.outcomes[1].answer == sitting.log.outcomes[1].answer);
    CHECK(sitting.second_log.calibrations.size() == 1);
    CHECK(sitting.log.calibrations.size() == 1);
    // The second's validation stands in its own record, and the session's says whose it was.
    CHECK(sitting.second_log.count("validation") == 1);
    CHECK(sitting.log.count("validation") == 1);
    CHECK(sitting.log.details_of("further eye tracker") ==
          std::vector<std::string>{"second: validation: mean error 0.000 deg, largest 0.000 deg"});
    CHECK(sitting.second_log.count("further eye tracker") == 0);
}

TEST_CASE("trials are judged by the session's own tracker alone", "[unit]") {
    SittingOfTwo sitting("[repeat]\ngaze_lost_limit = 0.2\ngaze_lost = \"now\"\n");
    sitting.second.blind = {0, 1};
    sitting.second.doubles = true;
    sitting.second.says = [](int) { return RecordingState::repeat; };
    CHECK(sitting.run().completed_trials == 2);
    CHECK(sitting.log.started == std::vector<int>{0, 1});
    CHECK(sitting.log.count("trial failed") == 0);
    REQUIRE(sitting.second_log.details_of("eye tracker").size() == 2);
    CHECK_THAT(sitting.second_log.details_of("eye tracker").front(), Contains("came twice"));
    CHECK(sitting.log.count("eye tracker") == 0);
}

TEST_CASE("a jump of a further tracker's clock is told and rejects no trial", "[unit]") {
    SittingOfTwo sitting;
    sitting.second.reads = [&clock = sitting.clock](int reading) {
        const SessionTime now = clock.now();
        const auto micros = std::chrono::floor<TrackerClock::duration>(now.time_since_epoch());
        return ClockPair{now, TrackerTime(micros + std::chrono::milliseconds(reading > 8 ? 50 : 0)), now};
    };
    CHECK(sitting.run().completed_trials == 2);
    CHECK(sitting.log.started == std::vector<int>{0, 1});
    REQUIRE(sitting.second_log.count("eye tracker's clock jumped") == 1);
    CHECK(sitting.log.count("eye tracker's clock jumped") == 0);
    CHECK_THAT(sitting.log.details_of("further eye tracker").back(),
               Contains("second: eye tracker's clock jumped: by +50.0"));
}

TEST_CASE("a further tracker that is lost ends no trial; the operator is asked before the next", "[unit]") {
    for (const bool at_start : {false, true}) {
        CAPTURE(at_start);
        SittingOfTwo sitting;
        if (at_start)
            sitting.second.fails_at = Step::start;
        else
            sitting.second.says = [](int recording) {
                return recording == 0 ? RecordingState::lost : RecordingState::running;
            };
        sitting.second.refused_reconnections = 1;
        CHECK(sitting.run().completed_trials == 2);
        CHECK(sitting.log.started == std::vector<int>{0, 1});
        CHECK(sitting.log.flips == 24);
        CHECK(sitting.second.reconnections == 2);
        CHECK(sitting.second.calibrations == 2);
        CHECK(sitting.tracker.calibrations == 1);
        CHECK(sitting.second_log.details_of("eye tracker lost") ==
              std::vector<std::string>{at_start ? "it is gone" : "", "it is still not there"});
        CHECK(sitting.second_log.count("eye tracker regained") == 1);
        CHECK(sitting.log.count("eye tracker lost") == 0);
        CHECK_THAT(sitting.log.details_of("operator asked").front(), Contains("second: "));
    }
}

TEST_CASE("a further tracker that the operator gives up is left out until it is calibrated again", "[unit]") {
    SittingOfTwo sitting;
    sitting.second.fails_at = Step::set_up;
    decline(sitting, "second: ");
    CHECK(sitting.run().completed_trials == 2);
    CHECK(sitting.second.marks.empty());
    CHECK(sitting.second_log.samples == 0);
    CHECK(sitting.second_log.flips == sitting.log.flips);
    CHECK_THAT(sitting.second_log.details_of("eye tracker").back(), Contains("is left out from here on"));

    SittingOfTwo again;
    again.second.fails_at = Step::set_up;
    bool was_pressed = false;
    again.panel.tell = [&](ScriptedPanel& panel) -> std::optional<ResponsePress> {
        if (panel.is_deciding() && !was_pressed)
            return ResponsePress{Pressed::no, {}}; // give it up
        if (panel.trial == 1 && panel.phase() == SessionPhase::task_screen && !was_pressed) {
            was_pressed = true;
            return ResponsePress{Pressed::recalibrate, {}};
        }
        return std::nullopt;
    };
    CHECK(again.run().completed_trials == 2);
    CHECK(again.second.reconnections == 1);
    CHECK(again.second.calibrations == 2);
    CHECK(again.second_log.samples == again.second.arrived);
    CHECK(again.second_log.samples > 0);
    CHECK(again.second_log.samples < again.log.samples);
}

TEST_CASE("practice leaves no rows in a further tracker's record, and its calibrations stand there",
          "[unit]") {
    SittingOfTwo plain, practised("[[practice]]\ntask = \"free\"\nobject = \"a\"\nmaterial = \"clay\"\n");
    CHECK(plain.run().completed_trials == 2);
    bool was_pressed = false;
    practised.panel.tell = [&](ScriptedPanel& panel) -> std::optional<ResponsePress> {
        if (panel.phase() != SessionPhase::task_screen || was_pressed)
            return std::nullopt;
        was_pressed = true;
        return ResponsePress{Pressed::recalibrate, {}};
    };
    CHECK(practised.run().completed_trials == 2);
    CHECK(practised.second_log.samples == plain.second_log.samples);
    CHECK(practised.second_log.flips == plain.second_log.flips);
    CHECK(practised.second.arrived > plain.second.arrived);
    REQUIRE(practised.second_log.calibrations.size() == 2);
    REQUIRE(practised.log.calibrations.size() == 2);
    CHECK(practised.log.calibrations[1].trial == -1);
}
