/// What the operator's keys do in each phase, on ports that do what they are told.
#include "experiment/ports/event_kinds.h"
#include "experiment/ports/response_panel.h"
#include "experiment/ports/session_phase.h"
#include "tests/experiment/record/plain_session.h"

using namespace overt;
using namespace overt::test;
using Catch::Contains;

namespace {

using Key = ResponsePress::Key;
using Phases = std::vector<SessionPhase>;

/// Presses the key once, when the trial is in the phase, and gives the answer to what is asked then.
auto press_once(SessionPhase phase, int trial, Key key, Key answer = Key::yes, char32_t digit = 0) {
    return [=, is_pressed = false,
            is_answered = false](ScriptedPanel& panel) mutable -> std::optional<ResponsePress> {
        if (!is_pressed && panel.phase() == phase && panel.trial == trial && !panel.is_deciding()) {
            is_pressed = true;
            return ResponsePress{key, {}};
        }
        if (is_pressed && !is_answered && panel.is_deciding()) {
            is_answered = true;
            return ResponsePress{digit ? Key::character : answer, {}, digit};
        }
        return std::nullopt;
    };
}

std::vector<std::string> phase_names_of(const Phases& phases) {
    std::vector<std::string> found;
    for (const SessionPhase phase : phases)
        found.emplace_back(name_of(phase));
    return found;
}

} // namespace

TEST_CASE("each change of phase is an event, in the order in which a session goes", "[unit]") {
    Sitting sitting(short_protocol("[breaks]\nevery_trials = 1\nmin_s = 0\n"));
    CHECK_FALSE(sitting.run().aborted);
    using enum SessionPhase;
    const Phases expected{set_up,          calibration, trial, task_screen, drift_check, stimulus,
                          response_screen, rest,        trial, task_screen, drift_check, stimulus,
                          response_screen, end};
    CHECK(sitting.panel.phases == expected);
    CHECK(sitting.log.details_of(phase_event) == phase_names_of(expected));
}

TEST_CASE("a session goes from phase to phase by its table, and nowhere from its end", "[unit]") {
    using enum SessionPhase;
    for (int i = 0; i < session_phase_count; ++i) {
        const auto phase = static_cast<SessionPhase>(i);
        CHECK(may_follow(phase, end));
        if (phase != end)
            CHECK_FALSE(may_follow(end, phase));
        // Nothing is shown that was not made ready and checked before.
        if (phase == calibration || phase == pause)
            continue; // they lead back
        // The steps of a trial come in any order, and each phase is entered once in a row.
        for (const SessionPhase step : {task_screen, drift_check, stimulus, response_screen})
            CHECK(may_follow(phase, step) == (phase == trial || (is_in_trial(phase) && phase != step)));
    }
    CHECK(may_follow(stimulus, pause));
}

TEST_CASE("a skipped trial does not come again, and the record says why", "[unit]") {
    for (const SessionPhase phase :
         {SessionPhase::task_screen, SessionPhase::stimulus, SessionPhase::response_screen}) {
        CAPTURE(name_of(phase));
        Sitting sitting(short_protocol("[repeat]\nrejected = \"now\"\n"));
        sitting.panel.tell = press_once(phase, 0, Key::skip, Key::yes, U'2');
        const SessionResult result = sitting.run();
        CHECK_FALSE(result.aborted);
        CHECK(sitting.log.started == std::vector<int>{0, 1});
        CHECK(sitting.log.completed == std::vector<bool>{false, true});
        REQUIRE(sitting.log.details_of("trial failed").size() == 1);
        CHECK_THAT(sitting.log.details_of("trial failed")[0],
                   Contains("skipped: observer's wish") && Contains("does not come again"));
        // The animation that was running went on to its end.
        CHECK(sitting.log.flips == (phase == SessionPhase::task_screen ? 12 : 24));
    }
}

TEST_CASE("a repeated trial comes again at once, as often as the operator wants", "[unit]") {
    Sitting sitting(short_protocol("[repeat]\nrejected = \"never\"\nmost_attempts = 1\n"));
    int left = 4;
    bool was_pressed = false;
    sitting.panel.tell = [&](ScriptedPanel& panel) -> std::optional<ResponsePress> {
        if (panel.phase() != SessionPhase::response_screen || panel.is_deciding() || left == 0)
            return std::nullopt;
        --left;
        was_pressed = true;
        return ResponsePress{Key::repeat, {}};
    };
    CHECK(sitting.run().completed_trials == 2);
    CHECK(was_pressed);
    CHECK(sitting.log.started == std::vector<int>{0, 0, 0, 0, 0, 1});
}

TEST_CASE("what is asked and taken back changes nothing but the log", "[unit]") {
    for (const Key key : {Key::skip, Key::repeat, Key::reject, Key::abort, Key::recalibrate}) {
        Sitting sitting(short_protocol(""));
        sitting.panel.tell = press_once(SessionPhase::task_screen, 1, key, Key::no);
        const SessionResult result = sitting.run();
        CHECK_FALSE(result.aborted);
        CHECK(result.completed_trials == 2);
        CHECK(sitting.log.started == std::vector<int>{0, 1});
        CHECK(sitting.log.count("operator asked") == 1);
        CHECK(sitting.log.details_of("operator answered") == std::vector<std::string>{"no"});
        CHECK(sitting.tracker.calibrations == 1);
    }
}

TEST_CASE("a calibration in between leads back to where it was asked for", "[unit]") {
    for (const SessionPhase phase :
         {SessionPhase::task_screen, SessionPhase::stimulus, SessionPhase::response_screen}) {
        Sitting sitting(short_protocol(""));
        sitting.panel.tell = press_once(phase, 0, Key::recalibrate);
        const SessionResult result = sitting.run();
        CHECK(result.completed_trials == 2);
        CHECK(sitting.tracker.calibrations == 2);
        CHECK(sitting.panel.times_in(SessionPhase::calibration) == 2);
        CHECK(sitting.panel.times_in(phase) == 3);
        CHECK(sitting.log.started == std::vector<int>{0, 1});
    }
}

TEST_CASE("a pause lasts until the operator ends it, whatever the observer presses", "[unit]") {
    Sitting sitting(short_protocol(""));
    bool has_paused = false;
    sitting.panel.tell = [&](ScriptedPanel& panel) -> std::optional<ResponsePress> {
        if (panel.phase() == SessionPhase::task_screen && !has_paused) {
            has_paused = true;
            return ResponsePress{Key::pause, {}};
        }
        if (panel.phase() == SessionPhase::pause && panel.looks == 1000)
            return ResponsePress{Key::pause, {}};
        return std::nullopt; // "next"
    };
    CHECK(sitting.run().completed_trials == 2);
    const auto said = sitting.log.details_of("operator");
    REQUIRE(said.size() == 2);
    CHECK(said[0] == "pauses");
    CHECK_THAT(said[1], Contains("goes on after 4.0 s"));
    // The question is shown again.
    const auto& texts = sitting.presenter.texts;
    CHECK(std::count(texts.begin(), texts.end(), "Look.") == 3);
    CHECK(std::count(texts.begin(), texts.end(), sitting.protocol.operators.pause_text) == 1);
}

TEST_CASE("the key that ends the session ends an animation; taken back, the trial comes again", "[unit]") {
    for (const bool is_meant : {true, false}) {
        Sitting sitting(short_protocol("[repeat]\nrejected = \"now\"\n"));
        sitting.panel.tell = press_once(SessionPhase::stimulus, 0, Key::abort, is_meant ? Key::yes : Key::no);
        const SessionResult result = sitting.run();
        CHECK(result.aborted == is_meant);
        CHECK(sitting.log.count("presentation broken off") == 1);
        CHECK(sitting.log.started == (is_meant ? std::vector<int>{0} : std::vector<int>{0, 0, 1}));
        CHECK(sitting.log.completed ==
              (is_meant ? std::vector<bool>{false} : std::vector<bool>{false, true, true}));
        // Everything up to the key is there.
        CHECK(sitting.log.outcomes[0].shown_refreshes > 0);
        CHECK(sitting.log.outcomes[0].shown_refreshes < 12);
        CHECK(sitting.log.outcomes[0].presentation_end > sitting.log.outcomes[0].presentation_onset);
        CHECK(sitting.log.kinds.back() == (is_meant ? session_aborted_event : session_completed_event));
    }
}

TEST_CASE("keys for trials have no effect where none is running, and the log says so", "[unit]") {
    Sitting sitting(short_protocol("[screens]\nwelcome_text = \"Hello.\"\n"));
    sitting.panel.tell = press_once(SessionPhase::set_up, -1, Key::skip);
    CHECK(sitting.run().completed_trials == 2);
    CHECK_THAT(sitting.log.details_of("operator").at(0), Contains("no effect"));
    CHECK(sitting.log.count("operator asked") == 0);
}

TEST_CASE("a digit that stands for no reason answers no question", "[unit]") {
    for (const Key key : {Key::abort, Key::recalibrate, Key::reject, Key::skip}) {
        CAPTURE(name_of(key));
        Sitting sitting(short_protocol("[operator]\nskip_reasons = [\"eye lost\", \"other\"]\n"));
        bool is_pressed = false;
        int digits = 0;
        sitting.panel.tell = [&](ScriptedPanel& panel) -> std::optional<ResponsePress> {
            if (!is_pressed && panel.phase() == SessionPhase::task_screen) {
                is_pressed = true;
                return ResponsePress{key, {}};
            }
            if (!panel.is_deciding())
                return std::nullopt;
            return digits++ < 50 ? ResponsePress{Key::character, {}, U'3'} : ResponsePress{Key::no, {}};
        };
        CHECK(sitting.run().completed_trials == 2);
        CHECK(digits == 51);
        CHECK(sitting.log.details_of("operator answered") == std::vector<std::string>{"no"});
    }
}

TEST_CASE("a key at the drift check is acted on before anything is presented", "[unit]") {
    using enum SessionPhase;
    Sitting skipped(short_protocol(""));
    skipped.panel.tell = press_once(drift_check, 0, Key::skip);
    CHECK(skipped.run().completed_trials == 1);
    CHECK(skipped.log.flips == 12); // of the second trial alone
    for (const Key key : {Key::pause, Key::recalibrate}) {
        CAPTURE(name_of(key));
        Sitting sitting(short_protocol("[screens]\ndrift_target_s = 1\n"));
        const SessionPhase between = key == Key::pause ? pause : calibration;
        SessionTime back, presented;
        sitting.panel.tell = [&, is_pressed =
                                     false](ScriptedPanel& panel) mutable -> std::optional<ResponsePress> {
            if (panel.phase() == drift_check && !is_pressed && panel.looks == 200) {
                is_pressed = true;
                return ResponsePress{key, {}};
            }
            if (panel.phase() == drift_check && is_pressed && panel.looks == 1 && panel.trial == 0)
                back = sitting.clock.now();
            if (panel.phase() == stimulus && panel.looks == 1 && panel.trial == 0)
                presented = sitting.clock.now();
            return panel.phase() == pause ? std::optional(ResponsePress{Key::pause, {}}) : std::nullopt;
        };
        CHECK(sitting.run().completed_trials == 2);
        const Phases begin(sitting.panel.phases.begin() + 3, sitting.panel.phases.begin() + 8);
        CHECK(begin == Phases{task_screen, drift_check, between, drift_check, stimulus});
        // The target stands its full time again.
        CHECK(to_seconds(presented - back) > 0.9);
    }
}

TEST_CASE("each key of the operator is in the log with the time at which it was pressed", "[unit]") {
    Sitting sitting(short_protocol(""));
    SessionTime pressed_at;
    sitting.panel.tell = [&, skip = press_once(SessionPhase::stimulus, 0, Key::skip)](
                             ScriptedPanel& panel) mutable -> std::optional<ResponsePress> {
        const auto press = skip(panel);
        if (press && press->key == Key::skip)
            pressed_at = sitting.clock.now();
        return press;
    };
    sitting.run();
    const auto& kinds = sitting.log.kinds;
    const auto at = std::find(kinds.begin(), kinds.end(), "operator pressed") - kinds.begin();
    REQUIRE(sitting.log.details_of("operator pressed") == std::vector<std::string>{"skip"});
    CHECK(sitting.log.times[static_cast<std::size_t>(at)] == pressed_at);
    // The question came after the last refresh.
    CHECK(kinds[static_cast<std::size_t>(at) + 1] == "operator asked");
    CHECK(sitting.log.times[static_cast<std::size_t>(at) + 1] > pressed_at);
}

TEST_CASE("a text stands until a key is pressed, however little time there is to answer", "[unit]") {
    Sitting sitting(short_protocol("[screens]\nresponse_min_s = 0\nresponse_max_s = 0.5\n"
                                   "[instructions]\npages = [\"Page.\"]\n"
                                   "[[block]]\nid = \"one\"\ninstructions = \"Block.\"\n"
                                   "[[practice]]\ntask = \"free\"\nobject = \"a\"\n"
                                   "material = \"clay\"\nfeedback = \"Good.\"\n"));
    using enum SessionPhase;
    constexpr int patience = 1000; // looks, 4 ms apart
    std::vector<std::string> stood;
    sitting.panel.tell =
        [&, looks = 0, texts = std::size_t{0}](ScriptedPanel& panel) mutable -> std::optional<ResponsePress> {
        const std::vector<std::string>& shown = sitting.presenter.texts;
        looks = shown.size() == texts ? looks + 1 : 0;
        texts = shown.size();
        if (panel.phase() == response_screen || panel.phase() == end || looks == patience) {
            if (looks == patience)
                stood.push_back(shown.back());
            return std::nullopt; // "next"
        }
        return ResponsePress{Key::character, {}};
    };
    CHECK(sitting.run().completed_trials == 2);
    CHECK(stood == std::vector<std::string>{sitting.protocol.screens.welcome_text, "Page.", "Block.", "Look.",
                                            "Good.", "Look.", "Look."});
    CHECK(sitting.log.details_of(text_shown_event) ==
          std::vector<std::string>{"welcome", "instructions, page 1 of 1", "instructions of block one",
                                   "feedback", "farewell"});
}

namespace {

/// Presses a key once, at a trial's question; decisions are answered with yes.
auto press_at_question(Key key, int trial = 0) {
    return [=, is_pressed = false](ScriptedPanel& panel) mutable -> std::optional<ResponsePress> {
        if (is_pressed || panel.phase() != SessionPhase::task_screen || panel.trial != trial)
            return std::nullopt;
        is_pressed = true;
        return ResponsePress{key, {}};
    };
}

} // namespace

TEST_CASE("a drift check of the operator's says what it found, and the trial goes on where it was",
          "[unit]") {
    const auto checked = [](std::function<void(Sitting&)> prepare) {
        Sitting sitting(short_protocol("[screens]\ndrift_target_s = 0.8\n"));
        sitting.panel.tell = press_at_question(Key::drift_check);
        prepare(sitting);
        CHECK(sitting.run().completed_trials == 2);
        CHECK(sitting.log.details_of(operator_pressed_event) == std::vector<std::string>{"drift check"});
        // The target stands for its time before anything is measured, in the trials and here.
        CHECK(sitting.presenter.targets.size() == 3);
        CHECK(std::ranges::count(sitting.presenter.texts, "Look.") == 3);
        // A calibration in between leads back to the question.
        CHECK(sitting.panel.times_in(SessionPhase::task_screen) == 1 + sitting.tracker.calibrations);
        std::vector<std::string> said;
        for (std::size_t i = 0; i < sitting.log.kinds.size(); ++i)
            if (sitting.log.kinds[i].starts_with("drift check") || sitting.log.kinds[i] == "operator")
                said.push_back(sitting.log.kinds[i] + ": " + sitting.log.details[i]);
        return std::pair(said, sitting.tracker.calibrations);
    };
    using Said = std::vector<std::string>;
    CHECK(checked([](Sitting& sitting) { sitting.tracker.first_drifts = {Degrees{0.25}}; }) ==
          std::pair(Said{"drift checked: 0.250 deg"}, 1));
    CHECK(checked([](Sitting& sitting) { sitting.tracker.first_drifts = {std::nullopt}; }) ==
          std::pair(Said{"drift check failed: no eye was found"}, 1));
    CHECK(checked([](Sitting& sitting) { sitting.tracker.set_ups_wanted = 1; }) ==
          std::pair(Said{"drift check failed: the tracker asked to be set up"}, 2));
    CHECK(checked([](Sitting& sitting) {
              sitting.tracker.fails_at = BlinkingTracker::Step::drift_check;
          }).second == 2);
    // Without a tracker there is nothing to check.
    Sitting without(short_protocol(""));
    without.tracker.is_there = false;
    without.panel.tell = press_at_question(Key::drift_check);
    CHECK(without.run().completed_trials == 2);
    CHECK(without.log.details_of(operator_event) ==
          std::vector<std::string>{"a drift check had no effect: the session has no eye tracker"});
    CHECK(without.presenter.targets.size() == 2);
    // It takes the time of its target.
    Sitting timed(short_protocol("[screens]\ndrift_target_s = 0.8\n"));
    SessionTime pressed;
    timed.panel.tell = [&, press = press_at_question(Key::drift_check)](
                           ScriptedPanel& panel) mutable -> std::optional<ResponsePress> {
        const auto told = press(panel);
        if (told)
            pressed = timed.clock.now();
        return told;
    };
    CHECK(timed.run().completed_trials == 2);
    const auto& kinds = timed.log.kinds;
    const auto at = std::ranges::find(kinds, drift_checked_event) - kinds.begin();
    CHECK(to_seconds(timed.log.times[static_cast<std::size_t>(at)] - pressed) == Approx(0.8).margin(0.02));
}

TEST_CASE("each reason to skip a trial has its digit, from 1 to 9, and a yes gives none", "[unit]") {
    const std::string reasons = "[operator]\nskip_reasons = [\"a\", \"b\", \"c\", \"d\", \"e\", \"f\", "
                                "\"g\", \"h\", \"i\"]\n";
    for (const char32_t digit : {U'1', U'5', U'9', U'0', U':', U'/'}) {
        const bool is_reason = digit >= U'1' && digit <= U'9';
        Sitting sitting(short_protocol(reasons));
        sitting.panel.tell = [digit, looks = 0, press = press_at_question(Key::skip)](
                                 ScriptedPanel& panel) mutable -> std::optional<ResponsePress> {
            if (!panel.is_deciding())
                return press(panel);
            return looks++ < 3 ? ResponsePress{Key::character, {}, digit} : ResponsePress{Key::yes, {}};
        };
        CHECK(sitting.run().completed_trials == 1);
        const std::string why =
            is_reason ? std::string(1, static_cast<char>('a' + (digit - U'1'))) : "no reason given";
        CHECK(sitting.log.details_of(operator_event) == std::vector<std::string>{"skips the trial: " + why});
        CHECK(sitting.log.details_of(operator_answered_event) == std::vector<std::string>{"yes"});
        CHECK_THAT(sitting.log.details_of("trial failed").front(), Contains("skipped: " + why));
    }
}

TEST_CASE("what the operator decides of a trial or of the session is in the record, in words", "[unit]") {
    const std::pair<Key, std::string> all[] = {{Key::repeat, "repeats the trial"},
                                               {Key::reject, "rejects the trial"},
                                               {Key::abort, "ends the session"}};
    for (const auto& [key, words] : all) {
        Sitting sitting(short_protocol(""));
        sitting.panel.tell = press_at_question(key);
        const SessionResult result = sitting.run();
        CHECK(sitting.log.details_of(operator_event) == std::vector<std::string>{words});
        CHECK(result.aborted == (key == Key::abort));
        CHECK(result.reason == (key == Key::abort ? "aborted by a key" : ""));
        // The question is as broad as what it would end.
        if (key == Key::abort)
            CHECK(sitting.log.details_of(operator_asked_event) ==
                  std::vector<std::string>{sitting.protocol.words.abort_in_trial});
    }
    Sitting before(short_protocol("[screens]\nwelcome_text = \"Hello.\"\n"));
    before.panel.tell = press_once(SessionPhase::set_up, -1, Key::abort);
    CHECK(before.run().aborted);
    CHECK(before.log.details_of(operator_asked_event) ==
          std::vector<std::string>{before.protocol.words.abort});
}

TEST_CASE("pages turn by the arrows, too, and other keys turn none", "[unit]") {
    Sitting sitting(short_protocol("[screens]\nwelcome_text = \"\"\n"
                                   "[instructions]\npages = [\"one\", \"two\", \"three\"]\n"));
    const std::vector<Key> keys{Key::left, Key::right, Key::up,   Key::right, Key::left,
                                Key::back, Key::right, Key::next, Key::next};
    std::size_t pressed = 0;
    sitting.panel.tell = [&](ScriptedPanel& panel) -> std::optional<ResponsePress> {
        return panel.phase() == SessionPhase::set_up && pressed < keys.size()
                   ? std::optional(ResponsePress{keys[pressed++], {}})
                   : std::nullopt;
    };
    CHECK(sitting.run().completed_trials == 2);
    std::vector<std::string> pages;
    for (const std::string& text : sitting.presenter.texts)
        if (text == "one" || text == "two" || text == "three")
            pages.push_back(text);
    CHECK(pages == std::vector<std::string>{"one", "one", "two", "three", "two", "one", "two", "three"});
    // A question is ended by none of them but "next".
    Sitting question(short_protocol(""));
    question.panel.tell = [](ScriptedPanel& panel) -> std::optional<ResponsePress> {
        constexpr Key others[] = {Key::left, Key::right, Key::back};
        return panel.phase() == SessionPhase::task_screen && panel.looks < 100
                   ? std::optional(ResponsePress{others[panel.looks % 3], {}})
                   : std::nullopt;
    };
    CHECK(question.run().completed_trials == 2);
    for (const TrialOutcome& outcome : question.log.outcomes)
        CHECK(to_seconds(*outcome.steps[0].end - *outcome.steps[0].begin) >= 0.004 * 95);
}
