/// Answers by keys, during the stimulus and after it, on ports that do what they are told.
#include <deque>
#include <tuple>

#include "experiment/ports/answer_offer.h"
#include "experiment/ports/marker_sink.h"
#include "experiment/ports/presentation_listener.h"
#include "experiment/ports/session_history.h"
#include "experiment/protocol/slot.h"
#include "experiment/session/answer_check.h"
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

TEST_CASE("a window opens with what the protocol says, and who answers is told of it once", "[unit]") {
    for (const std::string_view opens : {"onset", "offset", "screen"}) {
        CAPTURE(opens);
        std::string text(asked_at_stimulus);
        text.replace(text.find("correct = \"x\""), 13, fmt::format("correct = \"x\"\nopens = \"{}\"", opens));
        if (opens != "onset")
            text.replace(text.find(", until = \"answer\""), 18, "");
        Sitting sitting(short_protocol(text));
        sitting.panel.does = pressing({{150, "f"}, {170, "f", ObserverInput::Kind::key_up}});
        CHECK(sitting.run().completed_trials == 2);
        REQUIRE(sitting.log.outcomes.size() == 2);
        REQUIRE(sitting.panel.openings.size() >= 2);
        for (std::size_t i = 0; i < 2; ++i) {
            const TrialOutcome& outcome = sitting.log.outcomes[i];
            const SessionTime wanted = opens == "onset"    ? outcome.presentation_onset
                                       : opens == "offset" ? outcome.presentation_end
                                                           : outcome.response_screen_onset;
            REQUIRE(outcome.given.size() == 1);
            CHECK(outcome.given[0].window_onset == wanted);
            CHECK(std::ranges::count(sitting.panel.openings, wanted) >= 1);
            CHECK(*outcome.given[0].answered_at - wanted == from_seconds(0.15));
        }
    }
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
    // Its screen is drawn once: nothing on it changes before it is left.
    CHECK(std::ranges::count(sitting.presenter.screens, Screen::Kind::answers, &Screen::kind) == 2);
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

namespace {

constexpr std::string_view two_slots_text = R"([protocol]
name = "slots"
[animation]
duration_s = 0.5
[[slot]]
id = "left"
right_deg = -6
up_deg = 2
size_deg = 5
[[slot]]
id = "right"
right_deg = 6
up_deg = 2
size_deg = 5
[[object]]
id = "a"
shipped = "muse"
[[material]]
id = "gold"
kind = "smooth-conductor"
[[material]]
id = "clay"
kind = "diffuse"
[[task]]
id = "t"
question = "Which is nearer?"
slots = ["left", "right"]
trials = { rule = "pairs", of = "material" }
steps = [ { show = ["left", "right"], for_s = 0.5, until = "answer" }, { answer = "which", limit_s = 1 } ]
[[task.answer]]
id = "which"
kind = "choice"
choices = ["left", "right"]
)";

Protocol two_slots(std::string_view more) {
    const ReadText read(two_slots_text, more);
    INFO(read.diagnostics.print());
    REQUIRE(read.protocol);
    return *read.protocol;
}

/// Where a slot is, from the middle of the screen: its first pixel and the one after its last.
std::pair<glm::dvec2, glm::dvec2> edges_of(const Protocol& protocol, std::size_t slot) {
    const ScreenGeometry screen = slot_geometry(protocol, protocol.slots[slot]);
    const glm::dvec2 first = glm::dvec2(screen.image_origin_px) - 0.5 * glm::dvec2(screen.screen_px);
    return {first, first + glm::dvec2(screen.image_px)};
}

/// A click there, half so many milliseconds after the window has opened and then so many; once in a trial.
auto clicking(glm::dvec2 at, double ms = 100.0) {
    return [at, ms, done = 0, trial = -2](ScriptedPanel& panel,
                                          SessionTime now) mutable -> std::optional<ObserverInput> {
        if (std::exchange(trial, panel.trial) != panel.trial)
            done = 0;
        if (!panel.opened || done >= 2)
            return std::nullopt;
        const SessionTime due = *panel.opened + from_seconds(1e-3 * ms * (done == 0 ? 0.5 : 1.0));
        if (now < due)
            return std::nullopt;
        ObserverInput input{.kind = done == 0 ? ObserverInput::Kind::pointer_down
                                              : ObserverInput::Kind::pointer_up,
                            .at = due,
                            .device = ShortName("mouse")};
        input.right_px = at.x;
        input.down_px = at.y;
        input.button = 1;
        ++done;
        return input;
    };
}

} // namespace

TEST_CASE("choices that are slots are clicked on themselves, up to their edges, while they are shown",
          "[unit]") {
    const Protocol protocol = two_slots("with = \"mouse\"\n");
    for (const std::size_t slot : {std::size_t{0}, std::size_t{1}}) {
        const auto [first, end] = edges_of(protocol, slot);
        CHECK((first.x > 0.0) == (slot == 1));
        CHECK(end.y < 200.0);
        const glm::dvec2 middle = 0.5 * (first + end);
        const std::pair<glm::dvec2, bool> places[] = {
            {first, true},
            {end - 0.01, true},
            {middle, true},
            {{first.x - 0.01, middle.y}, false},
            {{middle.x, first.y - 0.01}, false},
            {{end.x, middle.y}, false},
            {{middle.x, end.y}, false},
        };
        for (const auto& [at, is_in] : places) {
            CAPTURE(slot, at.x, at.y);
            Sitting sitting(protocol);
            sitting.panel.does = clicking(at);
            CHECK_FALSE(sitting.run().aborted);
            REQUIRE_FALSE(sitting.log.outcomes.empty());
            for (const TrialOutcome& outcome : sitting.log.outcomes) {
                REQUIRE(outcome.given.size() == 1);
                CHECK(outcome.given[0].is_missed == !is_in);
                CHECK(outcome.given[0].value == (!is_in ? "" : slot == 0 ? "left" : "right"));
                CHECK(outcome.steps[0].ended_by == (is_in ? StepEnd::answer : StepEnd::time));
            }
            // The pointer is seen beside the stimuli, without the answer's items, and goes with them.
            REQUIRE(sitting.presenter.beside.size() == 2 * sitting.log.outcomes.size());
            for (std::size_t i = 0; i < sitting.presenter.beside.size(); ++i) {
                const std::optional<AnswerView>& view = sitting.presenter.beside[i];
                REQUIRE(view.has_value() == (i % 2 == 0));
                if (!view)
                    continue;
                CHECK(view->shows_pointer);
                CHECK(view->items.empty());
                CHECK(view->accept.empty());
                CHECK_FALSE(view->up_deg);
            }
        }
    }
    // Of a choice by keys no slot is clicked on, and nothing stands beside it.
    Sitting by_keys(two_slots("keys = [\"f\", \"j\"]\n"));
    const auto [first, end] = edges_of(protocol, 0);
    by_keys.panel.does = clicking(0.5 * (first + end));
    by_keys.run();
    CHECK(by_keys.log.outcomes.front().given[0].is_missed);
    CHECK(by_keys.presenter.beside.empty());
}

TEST_CASE("an answer that stands beside the stimulus is where the protocol says, and is clicked on there",
          "[unit]") {
    Sitting sitting(two_slots("with = \"mouse\"\nbeside_up_deg = -7\n"));
    std::vector<std::pair<double, double>> asked;
    sitting.presenter.place_at = [&](double right_px, double down_px) {
        asked.emplace_back(right_px, down_px);
        return right_px > 0.0 ? AnswerPlace{.item = 0, .option = 1} : AnswerPlace{};
    };
    sitting.panel.does = clicking({30.0, 400.0});
    sitting.run();
    for (const TrialOutcome& outcome : sitting.log.outcomes)
        CHECK(outcome.given.at(0).value == "right");
    REQUIRE_FALSE(asked.empty());
    for (const auto& [right_px, down_px] : asked) {
        CHECK(right_px == 30.0);
        CHECK(down_px == 400.0);
    }
    REQUIRE_FALSE(sitting.presenter.beside.empty());
    REQUIRE(sitting.presenter.beside.front());
    CHECK(sitting.presenter.beside.front()->up_deg == -7.0);
    CHECK(sitting.presenter.beside.front()->items.size() == 1);
}

TEST_CASE("inputs of one look count in the order of their times, whatever device they come from", "[unit]") {
    // Told in one look, the later ones first.
    constexpr double ms[] = {240.0, 230.0, 220.0, 235.0};
    constexpr std::string_view keys[] = {"j", "j", "f", "f"};
    Sitting sitting(short_protocol(asked_at_stimulus));
    sitting.panel.does = [&, done = std::size_t{0}, trial = -2](
                             ScriptedPanel& panel, SessionTime now) mutable -> std::optional<ObserverInput> {
        if (std::exchange(trial, panel.trial) != panel.trial)
            done = 0;
        if (!panel.opened || done >= std::size(ms) || now < *panel.opened + from_seconds(0.25))
            return std::nullopt;
        ObserverInput input{.kind = ObserverInput::Kind::key_down,
                            .at = *panel.opened + from_seconds(1e-3 * ms[done]),
                            .device = ShortName(done % 2 == 0 ? "box" : "keyboard")};
        input.key = ShortName(keys[done++]);
        return input;
    };
    CHECK(sitting.run().completed_trials == 2);
    for (const TrialOutcome& outcome : sitting.log.outcomes) {
        CHECK(outcome.given.at(0).value == "x"); // the press at 220 ms
        CHECK(outcome.given[0].response_time() == from_seconds(0.22));
        CHECK(outcome.given[0].device == "box");
        REQUIRE(outcome.inputs.size() == 4);
        for (std::size_t i = 1; i < 4; ++i)
            CHECK(outcome.inputs[i].input.at >= outcome.inputs[i - 1].input.at);
    }
}

namespace {

/// Notes what it is told of presentations.
struct Follower final : PresentationListener {
    void presentation_begins(const Trial& lit, int show) noexcept override {
        shows.emplace_back(lit.index, show, static_cast<int>(lit.shown_count()));
    }
    void flipped(const FlipRecord& flip) noexcept override { flips.push_back(flip.shown.value); }
    void slot_flipped(const SlotFlip& flip) noexcept override {
        places.push_back(flip.place);
        frames.push_back(flip.shown.value);
    }
    void screen_shown(const Screen&, SessionTime onset) noexcept override { screens.push_back(onset); }
    std::vector<std::tuple<int, int, int>> shows;
    std::vector<int> flips, places, frames;
    std::vector<SessionTime> screens;
};

} // namespace

TEST_CASE("each listener is told of every show, with the places of what it lights", "[unit]") {
    Sitting sitting(two_slots("keys = [\"f\", \"j\"]\n"));
    // The first show lights the right slot alone, the second both.
    std::string text(two_slots_text);
    const std::string_view steps = "{ show = [\"left\", \"right\"], for_s = 0.5, until = \"answer\" }";
    text.replace(
        text.find(steps), steps.size(),
        "{ show = \"right\", for_s = 0.1 }, { blank = 0.1 }, { show = [\"left\", \"right\"], for_s = 0.2 }");
    const ReadText read(text, "keys = [\"f\", \"j\"]\n");
    INFO(read.diagnostics.print());
    REQUIRE(read.protocol);
    sitting.protocol = *read.protocol;
    Follower one, other;
    sitting.listeners = {&one, &other};
    sitting.panel.does = pressing({{20, "f"}, {40, "f", ObserverInput::Kind::key_up}});
    const int trials = sitting.run().completed_trials;
    REQUIRE(trials >= 1);
    CHECK(one.shows == other.shows);
    CHECK(one.flips == other.flips);
    CHECK(one.places == other.places);
    CHECK(one.screens == other.screens);
    REQUIRE(one.shows.size() == 2 * static_cast<std::size_t>(trials));
    for (int trial = 0; trial < trials; ++trial) {
        CHECK(one.shows[static_cast<std::size_t>(2 * trial)] == std::tuple(trial, 0, 1));
        CHECK(one.shows[static_cast<std::size_t>(2 * trial + 1)] == std::tuple(trial, 1, 2));
    }
    // 12 refreshes of one, 24 of two, whose second is the place after the first of what is lit.
    CHECK(one.flips.size() == static_cast<std::size_t>(36 * trials));
    CHECK(one.places == std::vector<int>(static_cast<std::size_t>(24 * trials), 1));
    // Both move together.
    std::vector<int> seconds;
    for (int trial = 0; trial < trials; ++trial)
        seconds.insert(seconds.end(), one.flips.begin() + 36 * trial + 12,
                       one.flips.begin() + 36 * trial + 36);
    CHECK(one.frames == seconds);
    for (std::size_t i = 1; i < one.screens.size(); ++i)
        CHECK(one.screens[i] > one.screens[i - 1]);
}

TEST_CASE("while an answer is awaited the next trial's stimulus is expected, and none after the last",
          "[unit]") {
    for (const std::string_view text : {std::string_view(), asked_at_stimulus}) {
        Sitting sitting(short_protocol(text));
        sitting.panel.does = pressing({{700, "f"}});
        CHECK(sitting.run().completed_trials == 2);
        REQUIRE(sitting.presenter.loaded.size() == 2);
        CHECK(sitting.presenter.expected == std::vector<Stimulus>{sitting.presenter.loaded[1]});
    }
}

TEST_CASE("answers of earlier sittings count in a block's feedback, but for a block that began anew",
          "[unit]") {
    const std::string text = std::string(asked_at_stimulus) + "feedback = \"{correct} of {trials}\"\n";
    const auto feedback_after = [&](std::vector<RecordedStep> steps, int counted) {
        Sitting sitting(short_protocol(text));
        sitting.panel.does = pressing({{200, "f"}, {210, "f", ObserverInput::Kind::key_up}});
        SessionHistory history;
        history.steps = std::move(steps);
        history.counted_trials = counted;
        history.is_opened = true;
        CHECK_FALSE(sitting.run(history).aborted);
        std::string said;
        for (const std::string& words : sitting.presenter.texts)
            if (words.find(" of ") != std::string::npos)
                said += words + "; ";
        return fmt::format("{}{}", said, sitting.log.started.size());
    };
    GivenAnswer wrong;
    wrong.id = "which";
    wrong.kind = "choice";
    wrong.is_missed = false;
    wrong.value = "y";
    wrong.correct = "x";
    wrong.is_correct = false;
    using Kind = RecordedStep::Kind;
    const RecordedStep counted{
        .kind = Kind::trial, .trial = 0, .fate = AttemptFate::counted, .given = {wrong}};
    // Of two blocks each has its own.
    {
        Sitting sitting(short_protocol(
            text + "[[block]]\nid = \"c\"\ntasks = \"t\"\nfeedback = \"c: {correct} of {trials}\"\n"));
        sitting.panel.does = pressing({{200, "f"}, {210, "f", ObserverInput::Kind::key_up}});
        SessionHistory history;
        for (int trial = 0; trial < 3; ++trial)
            history.steps.push_back(
                {.kind = Kind::trial, .trial = trial, .fate = AttemptFate::counted, .given = {wrong}});
        history.steps.push_back({.kind = Kind::resumed, .policy = ResumePolicy::redo});
        history.counted_trials = 3;
        history.is_opened = true;
        CHECK_FALSE(sitting.run(history).aborted);
        CHECK(sitting.log.started == std::vector<int>{3});
        CHECK(has_said(sitting, "c: 1 of 2"));
    }
    CHECK(feedback_after({}, 0) == "2 of 2; 2");
    CHECK(feedback_after({counted, {.kind = Kind::resumed, .policy = ResumePolicy::redo}}, 1) == "1 of 2; 1");
    CHECK(feedback_after({counted, {.kind = Kind::resumed, .policy = ResumePolicy::restart_block}}, 0) ==
          "2 of 2; 2");
}

TEST_CASE("what became of each answer is told to the operator's log in its words", "[unit]") {
    RecordedAnswer answer;
    answer.samples = 1000;
    answer.voice_onset = SessionDuration{};
    const auto said = [](const RecordedAnswer& of) { return warnings_about(of); };
    using Said = std::vector<std::string>;
    CHECK(said(answer).empty());
    RecordedAnswer broken = answer;
    broken.fault = "the device went";
    CHECK(said(broken) == Said{"broke off: the device went"});
    RecordedAnswer clipped = answer;
    clipped.clipped_samples = 1;
    CHECK(said(clipped) == Said{"clipped: 1 samples at full scale; turn the microphone down"});
    RecordedAnswer silent = answer;
    silent.voice_onset.reset();
    silent.noise_dbfs = -61.4;
    silent.peak_dbfs = -40.6;
    CHECK(said(silent) ==
          Said{"silent: no voice above the noise of -61 dBFS, the loudest sample is at -41 dBFS"});
    RecordedAnswer empty;
    CHECK(said(empty) == Said{"empty: the sound device gave no sample"});
    empty.fault = "no device";
    CHECK(said(empty) == Said{"broke off: no device"});
    RecordedAnswer one = answer;
    one.samples = 1;
    one.voice_onset.reset();
    CHECK(said(one).size() == 1);
    CHECK_THAT(said(one).front(), Catch::StartsWith("silent"));
    RecordedAnswer lost = answer;
    lost.overruns = 1;
    lost.lost_samples = 480;
    CHECK(said(lost) == Said{"1 overruns, 480 samples lost"});
}

namespace {

/// Counts what a marker output is told.
class ResponseSink final : public MarkerSink {
  public:
    const std::string& name() const noexcept override { return name_; }
    void mark(const Marker& marker) noexcept override {
        if (marker.text == "RESPONSE")
            at.push_back(marker.at);
        texts.emplace_back(marker.text);
    }
    std::size_t poll(std::span<SentMarker>) noexcept override { return 0; }
    std::vector<std::string> finish() override { return {}; }
    std::vector<SessionTime> at;
    std::vector<std::string> texts;

  private:
    std::string name_ = "responses";
};

} // namespace

TEST_CASE("each answer is marked once, at its time, whether it is spoken or pressed", "[unit]") {
    const std::string output = "[[marker_output]]\nid = \"out\"\nkind = \"lsl\"\n";
    for (const std::string_view text : {std::string_view(), asked_at_stimulus}) {
        Sitting sitting(short_protocol(output + std::string(text)));
        ResponseSink sink;
        sitting.markers = {&sink};
        sitting.panel.does = pressing({{700, "f"}, {710, "f", ObserverInput::Kind::key_up}, {720, "j"}});
        CHECK(sitting.run().completed_trials == 2);
        REQUIRE(sink.at.size() == 2);
        for (std::size_t i = 0; i < 2; ++i)
            CHECK(sink.at[i] == sitting.log.outcomes[i].responded_at);
        // The same texts as a tracker is told, but for its frames, which an output has by its flips.
        CHECK(std::ranges::count(sink.texts, std::string(presentation_end_mark)) == 2);
        CHECK(std::ranges::count(sink.texts, "TRIALID 1") == 1);
        CHECK(std::ranges::count(sink.texts, "STEP fixation") == (text.empty() ? 0 : 2));
        CHECK(std::ranges::count(sink.texts, "TRIAL_RESULT 0") == 2);
    }
}
