/// A session whose eye tracker goes away, or whose clock or samples go wrong, at any step of it.
#include <catch2/catch.hpp>

#include "tests/experiment/record/plain_session.h"

using namespace overt;
using namespace overt::test;
using Catch::Matchers::Contains;
using Pressed = ResponsePress::Key;
using Step = BlinkingTracker::Step;

namespace {

/// Answers the operator's questions with no.
void decline_to_go_on(Sitting& sitting) {
    sitting.panel.tell = [](ScriptedPanel& panel) -> std::optional<ResponsePress> {
        return panel.is_deciding() ? std::optional(ResponsePress{Pressed::no, {}}) : std::nullopt;
    };
}

/// A tracker's clock that runs with the session's, put forward from one reading on.
std::function<ClockPair(int)> put_forward(const StandingClock& clock, int from, std::chrono::milliseconds by,
                                          int until = 1 << 30) {
    return [&clock, from, by, until](int reading) {
        const SessionTime now = clock.now();
        const auto micros = std::chrono::floor<TrackerClock::duration>(now.time_since_epoch());
        return ClockPair{now, TrackerTime(micros + (reading >= from && reading < until ? by : by * 0)), now};
    };
}

/// One sentence on a jump by so many milliseconds, to the microsecond that the tracker's clock counts in.
void check_jump(const Sitting& sitting, double ms, const std::string& when) {
    const std::vector<std::string> said = sitting.log.details_of("eye tracker's clock jumped");
    REQUIRE(said.size() == 1);
    CHECK(std::stod(said.front().substr(3)) == Approx(ms).margin(0.0015));
    CHECK_THAT(said.front(), Catch::StartsWith("by ") && Catch::EndsWith(" ms " + when));
}

} // namespace

TEST_CASE("a tracker that is gone at any step is asked for, connected and calibrated again", "[unit]") {
    for (const Step step : {Step::set_up, Step::drift_check, Step::start}) {
        CAPTURE(static_cast<int>(step));
        Sitting sitting(short_protocol(""));
        sitting.tracker.fails_at = step;
        sitting.tracker.refused_reconnections = 1;
        CHECK(sitting.run().completed_trials == 2);
        CHECK(sitting.tracker.reconnections == 2);
        CHECK(sitting.tracker.calibrations == 2);
        CHECK(sitting.log.details_of("eye tracker lost") ==
              std::vector<std::string>{"it is gone", "it is still not there"});
        CHECK(sitting.log.count("eye tracker regained") == 1);
        CHECK(sitting.log.count("presentation broken off") == 0);
        const auto started = step == Step::set_up ? std::vector<int>{0, 1} : std::vector<int>{0, 0, 1};
        // An attempt that could not begin comes again, and says why: nobody rejected it.
        std::vector<int> sorted = sitting.log.started;
        std::ranges::sort(sorted);
        CHECK(sorted == started);
        const auto is_lost = [](const TrialOutcome& outcome) {
            return outcome.failure == "eye tracker lost";
        };
        CHECK(std::ranges::count_if(sitting.log.outcomes, is_lost) == (step == Step::set_up ? 0 : 1));
        CHECK(std::ranges::count(sitting.log.outcomes, std::string("rejected"), &TrialOutcome::failure) == 0);

        Sitting ended(short_protocol(""));
        ended.tracker.fails_at = step;
        decline_to_go_on(ended);
        const SessionResult result = ended.run();
        CHECK(result.aborted);
        CHECK(result.reason == "the eye tracker was lost");
        CHECK(ended.tracker.reconnections == 0);
        CHECK(ended.log.flips == 0);
        // The session is over, and its last attempt says by what.
        if (step != Step::set_up)
            CHECK(ended.log.outcomes.back().failure == "eye tracker lost");
    }
}

TEST_CASE("an attempt in which the tracker's clock jumps does not count, and is said", "[unit]") {
    // Eight readings before and eight after each presentation.
    Sitting sitting(short_protocol(""));
    sitting.tracker.reads = put_forward(sitting.clock, 9, std::chrono::milliseconds(250));
    CHECK(sitting.run().completed_trials == 2);
    REQUIRE(sitting.log.completed.size() == 3);
    CHECK_FALSE(sitting.log.completed[0]);
    CHECK(sitting.log.outcomes[0].failure == "eye tracker's clock jumped");
    check_jump(sitting, 250.0, "in the trial");

    Sitting between(short_protocol(""));
    between.tracker.reads = put_forward(between.clock, 17, std::chrono::milliseconds(-250));
    CHECK(between.run().completed_trials == 2);
    CHECK(between.log.completed == std::vector<bool>{true, true});
    check_jump(between, -250.0, "before the trial");

    // One reading that was delayed is no jump.
    Sitting once(short_protocol(""));
    once.tracker.reads = put_forward(once.clock, 10, std::chrono::milliseconds(250), 11);
    CHECK(once.run().completed_trials == 2);
    CHECK(once.log.completed == std::vector<bool>{true, true});
    CHECK(once.log.count("eye tracker's clock jumped") == 0);
}

TEST_CASE("samples that come twice are recorded once, and counted", "[unit]") {
    Sitting sitting(short_protocol(""));
    sitting.tracker.doubles = true;
    CHECK(sitting.run().completed_trials == 2);
    CHECK(std::abs(sitting.tracker.arrived - 2 * sitting.log.samples) <= 2);
    const std::vector<std::string> said = sitting.log.details_of("eye tracker");
    REQUIRE(said.size() == 2);
    CHECK_THAT(said.front(), Contains("samples came twice and were left out the second time"));
}
