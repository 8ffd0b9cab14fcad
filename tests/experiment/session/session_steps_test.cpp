/// Practice, breaks and repeated trials, on ports that do what they are told.
#include "experiment/ports/response_panel.h"
#include "experiment/ports/session_phase.h"
#include "tests/experiment/record/plain_session.h"

using namespace overt;
using namespace overt::test;

TEST_CASE("practice shows its stimulus and its feedback, and leaves no rows but events", "[unit]") {
    Sitting sitting(short_protocol("[[practice]]\ntask = \"free\"\nobject = \"a\"\nmaterial = \"clay\"\n"
                                   "feedback = \"That was right.\"\n"));
    const SessionResult result = sitting.run();
    CHECK_FALSE(result.aborted);
    CHECK(result.completed_trials == 2);
    CHECK(sitting.presenter.loaded.size() == 3);
    CHECK(sitting.presenter.loaded.front() == Stimulus{0, 1});
    CHECK(sitting.log.started == std::vector<int>{0, 1});
    CHECK(sitting.log.flips == 2 * 12);
    CHECK(sitting.log.count("practice") == 1);
    CHECK(sitting.log.count("practice answered") == 1);
    const auto& texts = sitting.presenter.texts;
    CHECK(std::count(texts.begin(), texts.end(), "That was right.") == 1);
}

TEST_CASE("breaks stand on the screen for as long as they are to, and are noted", "[unit]") {
    for (const std::string pace : {"timed", "self"}) {
        Sitting sitting(short_protocol("[breaks]\nevery_trials = 1\npace = \"" + pace +
                                       "\"\nduration_s = 300\ntext = \"Rest.\"\n"));
        CHECK_FALSE(sitting.run().aborted);
        CHECK(sitting.log.count("break begins") == 1);
        CHECK(sitting.log.count("break ends") == 1);
        CHECK((to_seconds(sitting.clock.now() - SessionTime{}) > 300.0) == (pace == "timed"));
    }
}

TEST_CASE("a trial without gaze is repeated as the protocol says, and only the last attempt counts",
          "[unit]") {
    Sitting sitting(short_protocol("[repeat]\ngaze_lost = \"end-of-block\"\ngaze_lost_limit = 0.5\n"));
    sitting.tracker.blind = {0};
    const SessionResult result = sitting.run();
    CHECK_FALSE(result.aborted);
    CHECK(result.completed_trials == 2);
    CHECK(sitting.log.started == std::vector<int>{0, 1, 0});
    CHECK(sitting.log.completed == std::vector<bool>{false, true, true});
    CHECK(sitting.log.count("trial failed") == 1);
    // Without the rule it counts as it is.
    Sitting patient(short_protocol(""));
    patient.tracker.blind = {0};
    CHECK(patient.run().completed_trials == 2);
    CHECK(patient.log.started == std::vector<int>{0, 1});
}

TEST_CASE("a session without an eye tracker neither calibrates, nor checks drift, nor reads its clock",
          "[unit]") {
    for (const bool is_there : {true, false}) {
        CAPTURE(is_there);
        Sitting sitting(short_protocol(""));
        sitting.tracker.is_there = is_there;
        const SessionResult result = sitting.run();
        CHECK_FALSE(result.aborted);
        CHECK(result.completed_trials == 2);
        CHECK(sitting.tracker.calibrations == (is_there ? 1 : 0));
        CHECK(sitting.tracker.drift_checks == (is_there ? 2 : 0));
        CHECK((sitting.tracker.clock_readings > 0) == is_there);
        CHECK(sitting.log.count("validation") == (is_there ? 1 : 0));
        CHECK(sitting.log.count("calibration") == (is_there ? 0 : 1));
        CHECK(sitting.panel.times_in(SessionPhase::drift_check) == 2);
    }
}

TEST_CASE("a trial that the operator rejects comes again, or is left out, and the session ends in order",
          "[unit]") {
    for (const std::string when : {"now", "end-of-block", "never"}) {
        Sitting sitting(short_protocol("[repeat]\nrejected = \"" + when + "\"\n"));
        bool is_told = false;
        sitting.panel.tell = [&](ScriptedPanel& panel) -> std::optional<ResponsePress> {
            if (panel.phase() != SessionPhase::response_screen || panel.is_deciding() || is_told)
                return std::nullopt;
            is_told = true;
            return ResponsePress{ResponsePress::Key::reject, {}};
        };
        const SessionResult result = sitting.run();
        CHECK_FALSE(result.aborted);
        CHECK(result.completed_trials == (when == "never" ? 1 : 2));
        CHECK(sitting.log.started == (when == "now"            ? std::vector<int>{0, 0, 1}
                                      : when == "end-of-block" ? std::vector<int>{0, 1, 0}
                                                               : std::vector<int>{0, 1}));
        CHECK(sitting.log.kinds.back() == "session completed");
    }
}

TEST_CASE("practice that the operator repeats comes again at once; skipped, it was not answered", "[unit]") {
    using Key = ResponsePress::Key;
    for (const Key key : {Key::repeat, Key::reject, Key::skip}) {
        for (const std::string rejected : {"end-of-block", "never"}) {
            CAPTURE(name_of(key), rejected);
            Sitting sitting(short_protocol("[repeat]\nrejected = \"" + rejected +
                                           "\"\n[[practice]]\ntask = \"free\"\nobject = \"a\"\n"
                                           "material = \"clay\"\nfeedback = \"Good.\"\n"));
            int presses = 0;
            sitting.panel.tell = [&](ScriptedPanel& panel) -> std::optional<ResponsePress> {
                if (panel.phase() != SessionPhase::response_screen || panel.trial != -1 ||
                    panel.is_deciding() || presses > 0)
                    return std::nullopt;
                ++presses;
                return ResponsePress{key, {}};
            };
            CHECK(sitting.run().completed_trials == 2);
            CHECK(presses == 1);
            const bool again = key == Key::repeat || (key == Key::reject && rejected != "never");
            CHECK(sitting.log.count("practice") == (again ? 2 : 1));
            CHECK(sitting.log.count("practice answered") == (again ? 1 : 0));
            CHECK(sitting.log.count("practice skipped") == (again ? 0 : 1));
            const auto& texts = sitting.presenter.texts;
            CHECK(std::count(texts.begin(), texts.end(), "Good.") == (again ? 1 : 0));
            CHECK(sitting.log.started == std::vector<int>{0, 1});
        }
    }
}

TEST_CASE("samples that a slow link delivers after the end of the recording belong to the trial", "[unit]") {
    // 5000 are more than one look takes.
    for (const std::size_t late : {std::size_t{0}, std::size_t{3}, std::size_t{5000}}) {
        Sitting sitting(short_protocol(""));
        sitting.tracker.late = late;
        REQUIRE(sitting.run().completed_trials == 2);
        CHECK(sitting.log.samples == sitting.tracker.arrived);
        CHECK(sitting.tracker.arrived >= static_cast<int>(2 * late));
    }
}

TEST_CASE("a drift check fails beyond its limit, not at it, and where no eye was found", "[unit]") {
    const Protocol protocol = short_protocol("[tracker]\ndrift_limit_deg = 1.5\n");
    for (const auto& [drift_deg, failures] : {std::pair{1.499, 0}, {1.5, 0}, {1.501, 2}}) {
        CAPTURE(drift_deg);
        Sitting sitting(protocol);
        sitting.tracker.drift = Degrees{drift_deg};
        CHECK(sitting.run().completed_trials == 2);
        CHECK(sitting.log.count("drift check failed") == failures);
        for (const TrialOutcome& outcome : sitting.log.outcomes)
            CHECK(outcome.drift->value == drift_deg);
    }
    Sitting blind(protocol);
    blind.tracker.drift.reset();
    CHECK(blind.run().completed_trials == 2);
    CHECK(blind.log.details_of("drift check failed") ==
          std::vector<std::string>{"no eye was found", "no eye was found"});
    CHECK_FALSE(blind.log.outcomes[0].drift);
}
