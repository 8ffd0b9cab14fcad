/// Practice, breaks and repeated trials, on ports that do what they are told.
#include "experiment/ports/response_panel.h"
#include "experiment/ports/session_phase.h"
#include "experiment/protocol/all_stimuli.h"
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
    for (const ResponsePress::Key key :
         {ResponsePress::Key::repeat, ResponsePress::Key::reject, ResponsePress::Key::skip}) {
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
            const bool again = key == ResponsePress::Key::repeat ||
                               (key == ResponsePress::Key::reject && rejected != "never");
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
        if (failures > 0)
            CHECK(sitting.log.details_of("drift check failed").front() ==
                  "1.501 deg is more than the limit of 1.5 deg");
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

TEST_CASE("refreshes that go by are counted in the trial, in the session, and told to the tracker",
          "[unit]") {
    // Two before the fourth flip of the first trial, one before the last flip of the second.
    Sitting sitting(short_protocol("[repeat]\nmissed_refreshes = \"never\"\n"));
    sitting.presenter.passes = [](int flip) { return flip == 3 ? 2 : flip == 20 ? 1 : 0; };
    const SessionResult result = sitting.run();
    CHECK(result.completed_trials == 2);
    CHECK(result.missed_refreshes == 3);
    REQUIRE(sitting.log.outcomes.size() == 2);
    CHECK(sitting.log.outcomes[0].missed_refreshes == 2);
    CHECK(sitting.log.outcomes[0].shown_refreshes == 10);
    CHECK(sitting.log.outcomes[1].missed_refreshes == 1);
    std::vector<std::string> told;
    for (const auto& [at, text] : sitting.tracker.marks)
        if (text.starts_with("!V TRIAL_VAR missed_refreshes "))
            told.push_back(text.substr(30));
    CHECK(told == std::vector<std::string>{"2", "1"});
}

TEST_CASE("a trial comes again for missed refreshes where the protocol says so, and the record says how many",
          "[unit]") {
    Sitting sitting(short_protocol("[repeat]\nmissed_refreshes = \"now\"\nmissed_refreshes_limit = 1\n"));
    sitting.presenter.passes = [](int flip) { return flip == 3 ? 2 : flip == 15 ? 1 : 0; };
    CHECK(sitting.run().completed_trials == 2);
    CHECK(sitting.log.started == std::vector<int>{0, 0, 1});
    CHECK(sitting.log.completed == std::vector<bool>{false, true, true});
    REQUIRE(sitting.log.count("trial failed") == 1);
    CHECK_THAT(sitting.log.details_of("trial failed").front(),
               Catch::Contains("2 refreshes missed, 0.0 % of samples without gaze): comes again now"));
    CHECK(sitting.log.outcomes[0].afterwards == TrialOutcome::Afterwards::now);
    CHECK(sitting.log.outcomes[1].afterwards == TrialOutcome::Afterwards::never);
}

TEST_CASE(
    "steps that only stand last their refreshes, whatever is pressed, and keys end those that wait for one",
    "[unit]") {
    Sitting sitting(short_protocol(R"([[task]]
id = "t"
question = "Which?"
steps = [ { text = "Ready?", for_s = 0.25 }, { fixation = 0.3, id = "cross" }, { blank = 0.1 },
          { show = "centre", frame = 2, for_s = 0.2, until = "key" }, { mask = 0.15 },
          { answer = "spoken", limit_s = 3 }, { feedback = { answered = "Thanks", missed = "Late" }, for_s = 0.4 } ]
[[block]]
id = "b"
tasks = "t"
)"));
    CHECK(sitting.run().completed_trials == 2);
    for (const TrialOutcome& outcome : sitting.log.outcomes) {
        std::vector<std::string> rows;
        for (const AttemptStep& step : outcome.steps)
            rows.push_back(step.kind + " " + std::string(name_of(*step.ended_by)));
        CHECK(rows == std::vector<std::string>{"text time", "fixation time", "blank time", "show key",
                                               "mask time", "answer answer", "feedback time"});
        REQUIRE(outcome.steps.size() == 7);
        const int refreshes[] = {30, 36, 12, 24, 18, 360, 48};
        for (std::size_t i = 0; i < 7; ++i) {
            CAPTURE(i);
            CHECK(outcome.steps[i].planned_refreshes.value_or(360) == refreshes[i]);
            CHECK(outcome.steps[i].still_frame == (i == 3 ? std::optional(2) : std::nullopt));
            CHECK(outcome.steps[i].places.has_value() == (i == 3));
            CHECK(outcome.steps[i].id == (i == 1 ? "cross" : ""));
        }
        CHECK(outcome.steps[3].places == std::vector<int>{0});
        // Each begins where the one before ended, but for the lead of the recording and the answer.
        for (const std::size_t i : {2u, 3u, 4u, 6u})
            if (i != 6)
                CHECK(*outcome.steps[i].begin == *outcome.steps[i - 1].end);
        CHECK(outcome.shown_refreshes == 1); // the key came with the first
        CHECK(outcome.answer == "yes");
        CHECK(outcome.task_screen_onset == SessionTime());
    }
    using enum SessionPhase;
    CHECK(sitting.panel.phases == std::vector<SessionPhase>{set_up, calibration, trial, task_screen, stimulus,
                                                            response_screen, trial, task_screen, stimulus,
                                                            response_screen, end});
    const auto& texts = sitting.presenter.texts;
    CHECK(std::count(texts.begin(), texts.end(), "Thanks") == 2);
    CHECK(std::count(texts.begin(), texts.end(), "Ready?") == 2);
    CHECK(sitting.presenter.targets.size() == 2);
    CHECK(std::ranges::count(sitting.presenter.screens, Screen::Kind::noise, &Screen::kind) == 2);
}

TEST_CASE("an answer that does not come in time is missed, and the step that follows says so", "[unit]") {
    Sitting sitting(short_protocol(R"([[task]]
id = "t"
question = "Which?"
steps = [ { show = "centre", for_s = 0.1 }, { answer = "spoken", limit_s = 1.5 },
          { feedback = { answered = "Thanks", missed = "Late" }, for_s = 0.4 } ]
[[block]]
id = "b"
tasks = "t"
)"));
    sitting.panel.tell = [](ScriptedPanel& panel) -> std::optional<ResponsePress> {
        return panel.phase() == SessionPhase::response_screen
                   ? std::optional(ResponsePress{ResponsePress::Key::character, {}})
                   : std::nullopt;
    };
    CHECK(sitting.run().completed_trials == 2);
    CHECK(sitting.log.count("response timed out") == 2);
    for (const TrialOutcome& outcome : sitting.log.outcomes) {
        CHECK(outcome.steps[1].ended_by == StepEnd::time);
        CHECK(to_seconds(outcome.responded_at - outcome.response_screen_onset) == Approx(1.5).margin(1e-6));
        CHECK(outcome.answer.empty());
    }
    const auto& texts = sitting.presenter.texts;
    CHECK(std::count(texts.begin(), texts.end(), "Late") == 2);
    CHECK(std::count(texts.begin(), texts.end(), "Thanks") == 0);
    // It is told at the time that was up.
    const auto& kinds = sitting.log.kinds;
    const auto at = std::find(kinds.begin(), kinds.end(), "response timed out") - kinds.begin();
    CHECK(sitting.log.times[static_cast<std::size_t>(at)] == sitting.log.outcomes[0].responded_at);
}

TEST_CASE("a press before its screen has stood for its least time does not count", "[unit]") {
    Sitting sitting(
        short_protocol("[screens]\ntask_min_s = 0.7\nresponse_min_s = 1.2\nresponse_max_s = 9\n"));
    CHECK(sitting.run().completed_trials == 2);
    for (const TrialOutcome& outcome : sitting.log.outcomes) {
        REQUIRE(outcome.steps.size() == 4);
        // Keys are pressed all the time: the first that counts is one of the next look.
        CHECK(to_seconds(*outcome.steps[0].end - *outcome.steps[0].begin) == Approx(0.7).margin(0.02));
        CHECK(to_seconds(*outcome.steps[0].end - *outcome.steps[0].begin) >= 0.7);
        CHECK(to_seconds(outcome.responded_at - outcome.response_screen_onset) == Approx(1.2).margin(0.02));
        CHECK(to_seconds(outcome.responded_at - outcome.response_screen_onset) >= 1.2);
    }
}

TEST_CASE("time that the operator takes is not taken from the observer", "[unit]") {
    // A pause of two seconds a second after the response screen came up.
    Sitting sitting(short_protocol("[screens]\nresponse_min_s = 1.5\nresponse_max_s = 4\n"));
    for (const bool answers : {true, false}) {
        CAPTURE(answers);
        Sitting paused(sitting.protocol);
        SessionTime began, ended, again;
        paused.panel.tell = [&,
                             is_done = false](ScriptedPanel& panel) mutable -> std::optional<ResponsePress> {
            if (panel.phase() == SessionPhase::response_screen && panel.trial == 0 && !is_done) {
                if (panel.looks != 250)
                    return ResponsePress{ResponsePress::Key::character, {}};
                is_done = true;
                began = paused.clock.now();
                return ResponsePress{ResponsePress::Key::pause, {}};
            }
            if (panel.phase() == SessionPhase::pause) {
                ended = paused.clock.now();
                if (panel.looks == 500)
                    return ResponsePress{ResponsePress::Key::pause, {}};
            }
            if (is_done && panel.phase() == SessionPhase::response_screen && panel.trial == 0 &&
                panel.looks == 1)
                again = paused.clock.now();
            if (panel.phase() == SessionPhase::response_screen && panel.trial == 0 && !answers)
                return ResponsePress{ResponsePress::Key::character, {}};
            return std::nullopt;
        };
        CHECK(paused.run().completed_trials == 2);
        const TrialOutcome& outcome = paused.log.outcomes[0];
        const double open_s = to_seconds(outcome.responded_at - outcome.response_screen_onset);
        const double paused_s = to_seconds(again - began);
        CHECK(paused_s == Approx(2.0).margin(0.1));
        CHECK(open_s - paused_s == Approx(answers ? 1.5 : 4.0).margin(0.05));
    }
}

TEST_CASE("a break that ends by a key does so after the time in which none works", "[unit]") {
    Sitting sitting(short_protocol("[breaks]\nevery_trials = 1\npace = \"self\"\nmin_s = 20\n"));
    CHECK_FALSE(sitting.run().aborted);
    const auto time_of = [&](std::string_view kind) {
        const auto at = std::find(sitting.log.kinds.begin(), sitting.log.kinds.end(), kind);
        return sitting.log.times[static_cast<std::size_t>(at - sitting.log.kinds.begin())];
    };
    CHECK(to_seconds(time_of("break ends") - time_of("break begins")) == Approx(20.0).margin(0.05));
    // Who never comes back is waited for an hour.
    Sitting left(sitting.protocol);
    left.panel.tell = [](ScriptedPanel& panel) -> std::optional<ResponsePress> {
        return panel.phase() == SessionPhase::rest
                   ? std::optional(ResponsePress{ResponsePress::Key::character, {}})
                   : std::nullopt;
    };
    CHECK_FALSE(left.run().aborted);
    CHECK(to_seconds(left.clock.now() - SessionTime{}) > 3620.0);
    CHECK(to_seconds(left.clock.now() - SessionTime{}) < 3660.0);
}

TEST_CASE("the farewell stands until any key, and no longer than an answer may take", "[unit]") {
    Sitting sitting(short_protocol("[screens]\nresponse_max_s = 3\n"));
    SessionTime farewell;
    sitting.panel.tell = [&](ScriptedPanel& panel) -> std::optional<ResponsePress> {
        if (panel.phase() == SessionPhase::end && panel.looks == 1)
            farewell = sitting.clock.now();
        return std::nullopt;
    };
    CHECK_FALSE(sitting.run().aborted);
    CHECK(sitting.panel.looks == 1);
    CHECK(to_seconds(sitting.clock.now() - farewell) < 0.01);
    CHECK(sitting.log.details_of("text shown").back() == "farewell");
}

TEST_CASE("a machine that slept in a trial, and a wall clock that was set, are said with how much",
          "[unit]") {
    const auto said = [](double slept_s, double moved_s) {
        Sitting sitting(short_protocol(""));
        sitting.panel.tell = [&](ScriptedPanel& panel) -> std::optional<ResponsePress> {
            if (panel.phase() == SessionPhase::stimulus && panel.trial == 1)
                sitting.clock.disturbed = {from_seconds(slept_s), from_seconds(moved_s)};
            return std::nullopt;
        };
        CHECK(sitting.run().completed_trials == 2);
        std::string all;
        for (const std::string_view kind : {"machine slept", "wall clock was set"})
            for (const std::string& detail : sitting.log.details_of(kind))
                all += fmt::format("{}: {}. ", kind, detail);
        return all;
    };
    CHECK(said(0.0, 0.0).empty());
    CHECK(said(0.005, 0.1).empty());
    CHECK(said(0.005, -0.1).empty());
    CHECK(said(0.006, 0.0) == "machine slept: 0.006 s, in which nothing was shown or recorded. ");
    CHECK(said(0.0, 0.101) == "wall clock was set: by +0.101 s; session time went on as before. ");
    CHECK(said(2.5, -3.0) == "machine slept: 2.500 s, in which nothing was shown or recorded. "
                             "wall clock was set: by -3.000 s; session time went on as before. ");
}

TEST_CASE("a display that goes away ends the session wherever it is, and the record says so", "[unit]") {
    using enum SessionPhase;
    for (const SessionPhase phase :
         {set_up, calibration, task_screen, drift_check, stimulus, response_screen, rest}) {
        CAPTURE(name_of(phase));
        Sitting sitting(short_protocol("[breaks]\nevery_trials = 1\n[screens]\nwelcome_text = \"Hello.\"\n"
                                       "response_min_s = 0.2\ntask_min_s = 0.2\ndrift_target_s = 0.3\n"));
        if (phase == calibration)
            sitting.tracker.set_ups = {{SetupOutcome::Kind::failed, {}, {}, "no eye"}};
        bool is_gone = false;
        sitting.presenter.is_closed = [&] { return is_gone; };
        sitting.panel.tell = [&](ScriptedPanel& panel) -> std::optional<ResponsePress> {
            is_gone = is_gone || (panel.phase() == phase && panel.looks >= 3);
            return is_gone || (panel.phase() == phase && panel.trial <= 0)
                       ? std::optional(ResponsePress{ResponsePress::Key::character, {}})
                       : std::nullopt;
        };
        const SessionResult result = sitting.run();
        CHECK(is_gone);
        CHECK(result.aborted);
        CHECK(result.reason == "the display was closed");
        CHECK(sitting.log.details_of("session aborted") ==
              std::vector<std::string>{"the display was closed"});
        CHECK(result.completed_trials == (phase == rest ? 1 : 0));
        if (phase == stimulus) {
            REQUIRE(sitting.log.outcomes.size() == 1);
            CHECK(sitting.log.outcomes[0].shown_refreshes < 12);
            CHECK(sitting.log.outcomes[0].steps.back().ended_by == StepEnd::stopped);
        }
    }
}

TEST_CASE("one sample that came twice is said in the singular", "[unit]") {
    Sitting sitting(short_protocol(""));
    sitting.tracker.one_double = 8;
    CHECK(sitting.run().completed_trials == 2);
    CHECK(sitting.log.details_of("eye tracker") ==
          std::vector<std::string>{"1 sample came twice and was left out the second time"});
}

TEST_CASE("practice is noted with its number, its task and what it shows", "[unit]") {
    Sitting sitting(short_protocol("[[practice]]\ntask = \"free\"\nobject = \"a\"\nmaterial = \"gold\"\n"
                                   "[[practice]]\ntask = \"free\"\nobject = \"a\"\nmaterial = \"clay\"\n"));
    CHECK(sitting.run().completed_trials == 2);
    CHECK(sitting.log.details_of("practice") ==
          std::vector<std::string>{"1: free, " + stimulus_in_words(sitting.protocol, {0, 0}),
                                   "2: free, " + stimulus_in_words(sitting.protocol, {0, 1})});
    CHECK(sitting.log.details_of("practice answered") == std::vector<std::string>{"yes", "yes"});
    const auto told = [&](const std::string& text) {
        return std::ranges::count(sitting.tracker.marks, text, &std::pair<SessionTime, std::string>::second);
    };
    CHECK(told("TRIALID practice 1") == 1);
    CHECK(told("TRIALID practice 2") == 1);
    CHECK(told("TRIALID 1") == 1);
    // A skipped trial is told as one that came to nothing.
    Sitting skipped(short_protocol(""));
    skipped.panel.tell = [is_pressed = false](ScriptedPanel& panel) mutable -> std::optional<ResponsePress> {
        if (is_pressed || panel.phase() != SessionPhase::task_screen)
            return std::nullopt;
        is_pressed = true;
        return ResponsePress{ResponsePress::Key::skip, {}};
    };
    CHECK(skipped.run().completed_trials == 1);
    CHECK(std::ranges::count(skipped.tracker.marks, std::string("TRIAL_RESULT 1"),
                             &std::pair<SessionTime, std::string>::second) == 1);
    CHECK(std::ranges::count(skipped.tracker.marks, std::string("TRIAL_RESULT 0"),
                             &std::pair<SessionTime, std::string>::second) == 1);
}

TEST_CASE("gaze of a trial is all that was recorded in it, also where an answer parts the recording",
          "[unit]") {
    Sitting sitting(short_protocol(R"([screens]
recording_lead_s = 0.25
[[task]]
id = "t"
question = "Which?"
steps = [ { show = "centre", for_s = 0.1 }, { text = "And now?", for_s = 0.2 }, { show = "centre", for_s = 0.1, id = "again" } ]
[[block]]
id = "b"
tasks = "t"
)"));
    sitting.tracker.sample_rate_hz = 250.0;
    sitting.tracker.blind = {1, 2}; // the second of the first trial, the first of the second
    CHECK(sitting.run().completed_trials == 2);
    REQUIRE(sitting.log.yields.size() == 4);
    std::int64_t all = 0;
    for (std::size_t i = 0; i < 2; ++i) {
        const TrialOutcome& outcome = sitting.log.outcomes[i];
        REQUIRE(outcome.gaze);
        all += outcome.gaze->samples;
        CHECK(*outcome.gaze == sitting.log.yields[2 * i + 1]);
        CHECK(outcome.gaze->samples > sitting.log.yields[2 * i].samples);
        CHECK(outcome.gaze->without_gaze > 0);
        CHECK(outcome.gaze->without_gaze < outcome.gaze->samples);
        CHECK(outcome.gaze->missing >= sitting.log.yields[2 * i].missing);
        // Before the first flip and after the last as long as the protocol says.
        const SessionTime began = sitting.log.times[static_cast<std::size_t>(
            std::ranges::find(sitting.log.details, "stimulus") - sitting.log.details.begin())];
        if (i == 0)
            CHECK(to_seconds(outcome.presentation_onset - began) == Approx(0.25).margin(0.03));
    }
    CHECK(all == sitting.log.samples);
    CHECK(sitting.log.samples == sitting.tracker.arrived);
}

TEST_CASE("in a short break keys do nothing, too, and in one without a least time they work at once",
          "[unit]") {
    for (const double min_s : {0.0, 0.4}) {
        Sitting sitting(
            short_protocol(fmt::format("[breaks]\nevery_trials = 1\npace = \"self\"\nmin_s = {}\n", min_s)));
        CHECK_FALSE(sitting.run().aborted);
        const auto time_of = [&](std::string_view kind) {
            const auto at = std::find(sitting.log.kinds.begin(), sitting.log.kinds.end(), kind);
            return sitting.log.times[static_cast<std::size_t>(at - sitting.log.kinds.begin())];
        };
        CHECK(to_seconds(time_of("break ends") - time_of("break begins")) == Approx(min_s).margin(0.03));
    }
}
