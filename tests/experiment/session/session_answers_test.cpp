/// Answers by keys, during the stimulus and after it, on ports that do what they are told.
#include <deque>

#include "experiment/ports/answer_offer.h"
#include "tests/experiment/record/plain_session.h"

using namespace overt;
using namespace overt::test;

namespace {

/// A press or release so long after the window has opened, in ms; before it where that is negative: as soon
/// as inputs are told.
struct TimedKey {
    double ms;
    std::string_view key;
    ObserverInput::Kind kind = ObserverInput::Kind::key_down;
};

/// The same in each trial.
auto pressing(std::vector<TimedKey> keys) {
    return [keys, done = std::size_t{0},
            trial = -2](ScriptedPanel& panel, SessionTime now) mutable -> std::optional<ObserverInput> {
        if (std::exchange(trial, panel.trial) != panel.trial)
            done = 0;
        if (done >= keys.size())
            return std::nullopt;
        const TimedKey& next = keys[done];
        ObserverInput input{.kind = next.kind, .at = now, .device = ShortName("keyboard")};
        input.key = ShortName(next.key);
        if (next.ms >= 0.0) {
            if (!panel.opened || now < *panel.opened + from_seconds(1e-3 * next.ms))
                return std::nullopt;
            input.at = *panel.opened + from_seconds(1e-3 * next.ms);
        }
        ++done;
        return input;
    };
}

constexpr std::string_view asked_at_stimulus = R"([[task]]
id = "t"
question = "Which?"
steps = [ { fixation = 0.2 }, { show = "centre", for_s = 0.5, until = "answer" }, { answer = "which", limit_s = 1 },
          { feedback = { correct = "Right", wrong = "Wrong", missed = "Late" }, for_s = 0.1 } ]
[[task.answer]]
id = "which"
kind = "choice"
choices = ["x", "y"]
keys = ["f", "j"]
correct = "x"
[[block]]
id = "b"
tasks = "t"
)";

bool has_said(const Sitting& sitting, std::string_view words) {
    return std::ranges::find(sitting.presenter.texts, words) != sitting.presenter.texts.end();
}

} // namespace

TEST_CASE("an answer ends the stimulus, and its own screen is passed over", "[unit]") {
    Sitting sitting(short_protocol(asked_at_stimulus));
    sitting.panel.does = pressing({{-1, "j"}, {-1, "j", ObserverInput::Kind::key_up}, {200, "f"}});
    const SessionResult result = sitting.run();
    CHECK(result.completed_trials == 2);
    for (const TrialOutcome& outcome : sitting.log.outcomes) {
        REQUIRE(outcome.given.size() == 1);
        const GivenAnswer& given = outcome.given.front();
        CHECK(given.value == "x");
        CHECK(given.is_correct == true);
        CHECK(given.stimulus_onset == outcome.presentation_onset);
        CHECK(given.response_time() == from_seconds(0.2));
        CHECK_FALSE(given.screen_onset);
        REQUIRE(outcome.inputs.size() == 3);
        CHECK(outcome.inputs[0].state == InputState::before);
        CHECK(outcome.inputs[2].has_counted);
        // Of 60 refreshes those until the press was seen.
        CHECK(outcome.shown_refreshes >= 25);
        CHECK(outcome.shown_refreshes <= 27);
        REQUIRE(outcome.steps.size() == 3);
        CHECK(outcome.steps[1].ended_by == StepEnd::answer);
        CHECK(outcome.steps[2].kind == "feedback");
        CHECK(outcome.answer == "x");
    }
    CHECK(has_said(sitting, "Right"));
}

TEST_CASE("feedback is heard by what was answered, once, as it comes up", "[unit]") {
    const auto heard = [](std::string_view correct, std::vector<TimedKey> keys, std::string_view feedback) {
        std::string text(asked_at_stimulus);
        const auto put = [&](std::string_view was, std::string_view is) {
            text.replace(text.find(was), was.size(), is);
        };
        put("correct = \"x\"", correct);
        put("correct = \"Right\", wrong = \"Wrong\", missed = \"Late\"", feedback);
        Sitting sitting(short_protocol(text));
        sitting.panel.does = pressing(std::move(keys));
        CHECK(sitting.run().completed_trials == 2);
        return sitting.beeps;
    };
    using Beeps = std::vector<Beep>;
    const std::string_view tone = "tone = true", words = "correct = \"Right\", tone = true";
    CHECK(heard("correct = \"x\"", {{200, "f"}}, tone) == Beeps{Beep::correct, Beep::correct});
    CHECK(heard("correct = \"x\"", {{200, "j"}}, words) == Beeps{Beep::wrong, Beep::wrong});
    CHECK(heard("correct = \"x\"", {}, words) == Beeps{Beep::missed, Beep::missed});
    CHECK(heard("correct = \"none\"", {{200, "j"}}, tone) == Beeps{Beep::answered, Beep::answered});
    CHECK(heard("correct = \"x\"", {{200, "f"}}, "correct = \"Right\", tone = false").empty());
}

TEST_CASE("a window that the stimulus opened outlasts it", "[unit]") {
    Sitting sitting(short_protocol(asked_at_stimulus));
    sitting.panel.does = pressing({{700, "j"}});
    CHECK(sitting.run().completed_trials == 2);
    const TrialOutcome& outcome = sitting.log.outcomes.front();
    CHECK(outcome.shown_refreshes == 60);
    const GivenAnswer& given = outcome.given.front();
    CHECK(given.value == "y");
    CHECK(given.is_correct == false);
    CHECK(given.response_time() == from_seconds(0.7));
    REQUIRE(given.screen_onset);
    CHECK(*given.screen_onset > *given.stimulus_onset + from_seconds(0.5));
    CHECK(outcome.steps[1].ended_by == StepEnd::time);
    CHECK(outcome.steps[2].kind == "answer");
    CHECK(outcome.steps[2].ended_by == StepEnd::answer);
    CHECK(has_said(sitting, "Wrong"));
}

TEST_CASE("a key that is held from before the stimulus on does not answer, and time is up", "[unit]") {
    Sitting sitting(short_protocol(asked_at_stimulus));
    sitting.panel.does = pressing({{-1, "f"}, {100, "f"}});
    CHECK(sitting.run().completed_trials == 2);
    const TrialOutcome& outcome = sitting.log.outcomes.front();
    CHECK(outcome.given.front().is_missed);
    CHECK_FALSE(outcome.given.front().is_correct);
    CHECK(outcome.inputs.size() == 1);
    CHECK(outcome.steps[2].ended_by == StepEnd::time);
    CHECK(sitting.log.count("response timed out") == 2);
    CHECK(has_said(sitting, "Late"));
}

TEST_CASE("several screens of answers follow one another", "[unit]") {
    Sitting sitting(short_protocol(R"([[task]]
id = "t"
question = "Rate it."
steps = [ { show = "centre", for_s = 0.1 }, { answer = "gloss" }, { answer = "sure" } ]
[[task.answer]]
id = "gloss"
kind = "scale"
steps = 5
of = ["body", "head"]
per_screen = 1
accept = "at-once"
[[task.answer]]
id = "sure"
kind = "scale"
[[block]]
id = "b"
tasks = "t"
)"));
    // On each page so long after its window opened.
    sitting.panel.does = [pages = std::optional<SessionTime>(), step = 0](
                             ScriptedPanel& panel, SessionTime now) mutable -> std::optional<ObserverInput> {
        if (!panel.opened || panel.phase() != SessionPhase::response_screen ||
            now < *panel.opened + from_seconds(0.3))
            return std::nullopt;
        if (pages != panel.opened) {
            pages = panel.opened;
            step = 0;
        }
        constexpr std::string_view keys[] = {"4", "right", "right", "enter"};
        if (step >= 4)
            return std::nullopt;
        ObserverInput input{
            .kind = ObserverInput::Kind::key_down, .at = now, .device = ShortName("keyboard")};
        static bool is_down = false;
        input.key = ShortName(keys[step]);
        if (std::exchange(is_down, !is_down)) {
            input.kind = ObserverInput::Kind::key_up;
            ++step;
        }
        return input;
    };
    CHECK(sitting.run().completed_trials == 2);
    const std::vector<GivenAnswer>& given = sitting.log.outcomes.front().given;
    REQUIRE(given.size() == 3);
    CHECK(given[0].number == 4.0);
    CHECK(given[1].number == 4.0);
    CHECK(given[2].number == 51.0);
    CHECK(*given[1].screen_onset > *given[0].answered_at);
    CHECK(given[2].key == "enter");
}

TEST_CASE("what is pressed after a window has closed is late, in the steps that follow, too", "[unit]") {
    Sitting sitting(short_protocol(R"([[task]]
id = "t"
question = "Which?"
steps = [ { show = "centre", for_s = 0.1, until = "answer" }, { answer = "which", limit_s = 0.4 },
          { blank = 0.5 } ]
[[task.answer]]
id = "which"
kind = "choice"
choices = ["x", "y"]
keys = ["f", "j"]
correct = "x"
limit_s = 0.3
[[block]]
id = "b"
tasks = "t"
)"));
    // After the window's end a step follows, in which the observer presses both keys.
    sitting.panel.does = [opened = std::optional<SessionTime>(), done = std::size_t{0}, trial = -2](
                             ScriptedPanel& panel, SessionTime now) mutable -> std::optional<ObserverInput> {
        constexpr TimedKey keys[] = {{350, "f"}, {360, "f", ObserverInput::Kind::key_up}, {600, "j"}};
        if (std::exchange(trial, panel.trial) != panel.trial)
            opened.reset(), done = 0;
        if (panel.opened)
            opened = panel.opened;
        if (!opened || done >= std::size(keys) || now < *opened + from_seconds(1e-3 * keys[done].ms))
            return std::nullopt;
        ObserverInput input{.kind = keys[done].kind, .at = now, .device = ShortName("keyboard")};
        input.key = ShortName(keys[done++].key);
        return input;
    };
    CHECK(sitting.run().completed_trials == 2);
    for (const TrialOutcome& outcome : sitting.log.outcomes) {
        REQUIRE(outcome.given.size() == 1);
        CHECK(outcome.given.front().is_missed);
        CHECK(outcome.given.front().value.empty());
        REQUIRE(outcome.inputs.size() == 3);
        for (const AnswerInput& input : outcome.inputs) {
            CHECK(input.state == InputState::late);
            CHECK_FALSE(input.has_counted);
        }
        CHECK(outcome.answer.empty());
    }
}

TEST_CASE("a press while nothing is shown between stimulus and answer has its own time", "[unit]") {
    Sitting sitting(short_protocol(R"([[task]]
id = "t"
question = "Which?"
steps = [ { show = "centre", for_s = 0.2, until = "answer" }, { blank = 0.5 }, { answer = "which", limit_s = 1 } ]
[[task.answer]]
id = "which"
kind = "choice"
choices = ["x", "y"]
keys = ["f", "j"]
[[block]]
id = "b"
tasks = "t"
)"));
    // Told when it is asked for, as a window does.
    sitting.panel.does = [opened = std::optional<SessionTime>(), trial = -2, is_done = false](
                             ScriptedPanel& panel, SessionTime now) mutable -> std::optional<ObserverInput> {
        if (std::exchange(trial, panel.trial) != panel.trial)
            opened.reset(), is_done = false;
        if (panel.opened)
            opened = panel.opened;
        if (is_done || !opened || now < *opened + from_seconds(0.4))
            return std::nullopt;
        is_done = true;
        ObserverInput input{
            .kind = ObserverInput::Kind::key_down, .at = now, .device = ShortName("keyboard")};
        input.key = ShortName("j");
        return input;
    };
    CHECK(sitting.run().completed_trials == 2);
    for (const TrialOutcome& outcome : sitting.log.outcomes) {
        REQUIRE(outcome.given.size() == 1);
        const GivenAnswer& given = outcome.given.front();
        CHECK(given.value == "y");
        CHECK(to_seconds(*given.response_time()) == Approx(0.4).margin(0.01));
        CHECK_FALSE(given.screen_onset); // its screen is passed over
    }
}

TEST_CASE("a block's feedback comes right after its trials, and its questions after that", "[unit]") {
    Protocol protocol = short_protocol(std::string(asked_at_stimulus) + R"(feedback = "{percent_correct} %"
[[block]]
id = "c"
tasks = "t"
feedback = "{correct} of {trials}"
[[observer_field]]
id = "effort_b"
title = "Effort in b?"
required = false
kind = "text"
when = "block:b"
[[observer_field]]
id = "effort_c"
title = "Effort in c?"
required = false
kind = "text"
when = "block:c"
[[observer_field]]
id = "remarks"
title = "Remarks?"
required = false
kind = "text"
when = "end"
)");
    Sitting sitting(protocol);
    sitting.fields.resize(3);
    sitting.panel.does = pressing({{200, "f"}, {210, "f", ObserverInput::Kind::key_up}});
    CHECK(sitting.run().completed_trials == 4);
    std::vector<std::string> order;
    for (const Screen& screen : sitting.presenter.screens) {
        std::string what = screen.text;
        if (screen.kind == Screen::Kind::form && !screen.rows.empty())
            what = screen.rows.front().label.substr(0, screen.rows.front().label.find(" ("));
        if (what != "100 %" && what != "2 of 2" && !what.starts_with("Effort") && what != "Remarks?")
            continue;
        if (order.empty() || order.back() != what)
            order.push_back(what);
    }
    CHECK(order == std::vector<std::string>{"100 %", "Effort in b?", "2 of 2", "Effort in c?", "Remarks?"});
}
