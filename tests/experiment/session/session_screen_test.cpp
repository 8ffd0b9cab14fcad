/// A screen that is not what it was any more, and times that nothing proves.
#include <cmath>
#include <cstdio>
#include <numbers>

#include "experiment/session/missed_in_words.h"
#include "experiment/session/session_screens.h"
#include "experiment/session/step_screens.h"
#include "tests/experiment/record/plain_session.h"

using namespace overt;
using namespace overt::test;
using Catch::Matchers::Contains;
using Pressed = ResponsePress::Key;

namespace {

/// Told once, before the second trial.
void change_screen(Sitting& sitting, std::vector<std::string> changes) {
    sitting.screen_changes = [&sitting, changes, is_told = false]() mutable -> std::vector<std::string> {
        if (is_told || sitting.log.completed.empty())
            return {};
        is_told = true;
        return changes;
    };
}

} // namespace

TEST_CASE("what has changed of the screen is recorded, and the operator asked whether to go on", "[unit]") {
    Sitting sitting(short_protocol("[words]\nscreen_changed = \"Another screen?\"\n"));
    change_screen(sitting, {"a compositor (picom) has taken the screen", "the gamma table is another"});
    const bool goes_on = GENERATE(true, false);
    sitting.panel.tell = [&](ScriptedPanel& panel) -> std::optional<ResponsePress> {
        return panel.is_deciding() && !sitting.log.completed.empty()
                   ? std::optional(ResponsePress{goes_on ? Pressed::yes : Pressed::no, {}})
                   : std::nullopt;
    };
    const SessionResult result = sitting.run();
    CHECK(
        sitting.log.details_of(screen_changed_event) ==
        std::vector<std::string>{"a compositor (picom) has taken the screen", "the gamma table is another"});
    REQUIRE(sitting.log.count(operator_asked_event) == 1);
    CHECK_THAT(sitting.log.details_of(operator_asked_event).front(),
               Contains("Another screen?\na compositor (picom)") && Contains("the gamma table is another"));
    CHECK(result.aborted == !goes_on);
    CHECK(result.completed_trials == (goes_on ? 2 : 1));
    if (!goes_on)
        CHECK(result.reason == "the screen changed: a compositor (picom) has taken the screen");
}

TEST_CASE("what changes in the last trial is recorded without a question", "[unit]") {
    Sitting sitting(short_protocol(""));
    sitting.screen_changes = [&sitting]() -> std::vector<std::string> {
        return sitting.log.completed.size() == 2 ? std::vector<std::string>{"the window was hidden"}
                                                 : std::vector<std::string>();
    };
    CHECK(sitting.run().completed_trials == 2);
    CHECK(sitting.log.count(screen_changed_event) == 1);
    CHECK(sitting.log.count(operator_asked_event) == 0);
}

TEST_CASE("without proven times no number of missed refreshes is told to the tracker", "[unit]") {
    Sitting sitting(short_protocol(""));
    sitting.has_proven_times = GENERATE(true, false);
    sitting.run();
    const auto told = [&](const std::string& text) {
        return std::ranges::any_of(sitting.tracker.marks,
                                   [&](const auto& mark) { return mark.second == text; });
    };
    CHECK(told("!V TRIAL_VAR missed_refreshes 0") == sitting.has_proven_times);
    CHECK(told("!V TRIAL_VAR missed_refreshes unproven") != sitting.has_proven_times);
    CHECK(missed_in_words(0, true) == "0 refreshes missed");
    CHECK(missed_in_words(0, false) == "missed refreshes: unproven");
    CHECK(missed_in_words(1, false) == "1 refresh missed, by times that nothing proves");
}

namespace {

/// A screen by its short name; fails where there is none.
Screen screen_named(const Protocol& protocol, std::string_view name) {
    for (const auto& [own, screen] : screens::all_of(protocol))
        if (own == name)
            return screen;
    FAIL("no screen " << name);
    return {};
}

std::string hints_of(const Screen& screen) {
    std::string all;
    for (const KeyHint& hint : screen.keys)
        all += "[" + hint.key + "|" + hint.does + "]";
    return all;
}

} // namespace

TEST_CASE("the screens of a protocol come in the order of a session, each with its words and keys",
          "[unit]") {
    const Protocol protocol = short_protocol(R"([consent]
text = "Agree?"
accept_key = "j"
decline_key = "z"
[instructions]
pages = ["One.", "Two."]
[screens]
farewell_text = "Thanks."
response_text = "Say it."
[breaks]
every_trials = 1
pace = "self"
min_s = 7
text = "Rest."
[operator]
skip_reasons = ["eye lost", "other"]
pause = "p"
[[observer_field]]
id = "remarks"
title = "Remarks?"
required = false
kind = "text"
when = "end"
[[observer_field]]
id = "effort"
title = "Effort?"
required = false
kind = "text"
when = "block:b"
[[observer_field]]
id = "age"
title = "Age?"
kind = "number"
[[practice]]
task = "free"
object = "a"
material = "clay"
feedback = "Good."
[[block]]
id = "b"
tasks = "free"
instructions = "Now b."
)");
    std::vector<std::string> names;
    for (const auto& [name, screen] : screens::all_of(protocol))
        names.push_back(name);
    std::vector<std::string> forms;
    std::erase_if(names, [&](const std::string& name) {
        if (name.starts_with("form"))
            forms.push_back(name);
        return name.starts_with("form");
    });
    CHECK(names == std::vector<std::string>{"consent",
                                            "welcome",
                                            "instructions_1",
                                            "instructions_2",
                                            "please_wait",
                                            "calibration_target",
                                            "validation",
                                            "validation_poor",
                                            "drift_check_target",
                                            "block_b",
                                            "question_free",
                                            "response",
                                            "feedback_1",
                                            "break",
                                            "break_over",
                                            "farewell",
                                            "operator_pause",
                                            "keyboard_lost",
                                            "operator_recalibrate",
                                            "operator_not_calibrated",
                                            "operator_tracker_lost",
                                            "operator_repeat",
                                            "operator_reject",
                                            "operator_skip",
                                            "operator_abort",
                                            "operator_abort_in_trial"});
    std::ranges::sort(forms);
    CHECK(forms == std::vector<std::string>{"form", "form_after_b", "form_end"});
    const auto says = [&](std::string_view name, std::string_view text, std::string_view hints) {
        CAPTURE(name);
        const Screen screen = screen_named(protocol, name);
        CHECK(screen.text == text);
        CHECK(hints_of(screen) == hints);
    };
    const WordSettings& words = protocol.words;
    says("consent", "Agree?", "[J|I agree][Z|I do not agree]");
    says("instructions_1", "One.", "[space bar|go on]");
    says("instructions_2", "Two.", "[←|back][space bar|go on]");
    says("please_wait", words.please_wait, "");
    says("block_b", "Now b.", "[space bar|go on]");
    says("question_free", "Look.", "[space bar|go on]");
    says("response", "Say it.", "[space bar|I have answered]");
    says("feedback_1", "Good.", "[space bar|go on]");
    says("break", "Rest.", "[|keys work after 7 s]");
    says("break_over", "Rest.", "[space bar|go on]");
    says("farewell", "Thanks.", "[space bar|close]");
    says("operator_pause", protocol.operators.pause_text, "[P|go on]");
    says("keyboard_lost", words.keyboard_lost, "");
    says("operator_skip", words.skip + "\n\n1: yes, eye lost\n2: yes, other", "[Y|yes][N|no]");
    says("operator_abort", words.abort, "[Y|yes][N|no]");
    says("operator_abort_in_trial", words.abort_in_trial, "[Y|yes][N|no]");
    CHECK(screen_named(protocol, "instructions_2").page == 2);
    CHECK(screen_named(protocol, "instructions_2").pages == 2);
    CHECK(screen_named(protocol, "instructions_1").page == 1);
    // A frame is around what is not the observer's.
    for (const auto& [name, screen] : screens::all_of(protocol)) {
        CAPTURE(name);
        const bool is_operators =
            name.starts_with("operator") || name.starts_with("validation") || name == "keyboard_lost";
        CHECK(screen.frame == (is_operators ? words.experimenter : ""));
    }

    // Where the question is repeated each task has a screen of its own; a timed break has no second screen.
    Protocol other = protocol;
    other.screens.repeat_question = true;
    other.breaks.pace = BreakPace::timed;
    other.breaks.duration_s = 90.4;
    other.tasks.push_back(other.tasks.front());
    other.tasks.back().id = "again";
    other.tasks.back().question = "Once more.";
    CHECK(screen_named(other, "response_free").text == "Look.\n\nSay it.");
    CHECK(screen_named(other, "response_again").text == "Once more.\n\nSay it.");
    CHECK(screen_named(other, "question_again").text == "Once more.");
    CHECK(hints_of(screen_named(other, "break")) == "[|goes on by itself after 90 s]");
    const auto has = [&](std::string_view name) {
        const auto all = screens::all_of(other);
        return std::ranges::any_of(all, [&](const auto& each) { return each.first == name; });
    };
    CHECK_FALSE(has("break_over"));
    CHECK_FALSE(has("response"));
    other.screens.repeat_question = false;
    CHECK(has("response"));
    CHECK_FALSE(has("response_again"));
    other.breaks.every_trials = 0;
    CHECK_FALSE(has("break"));
    other.breaks.between_blocks = true;
    CHECK(has("break"));
    other.screens.farewell_text.clear();
    CHECK_FALSE(has("farewell"));
    CHECK(screens::break_asleep_s(other.breaks) == 90.4);
    other.breaks.pace = BreakPace::self;
    CHECK(screens::break_asleep_s(other.breaks) == 7.0);
}

TEST_CASE("examples of validations are off by what they say, at each target in both eyes", "[unit]") {
    const Protocol protocol = short_protocol("[calibration]\nmean_limit_deg = 0.5\nmax_limit_deg = 1\n");
    const ScreenGeometry geometry = screen_geometry_of(protocol);
    for (const bool is_poor : {false, true}) {
        const Screen screen = screen_named(protocol, is_poor ? "validation_poor" : "validation");
        const double off_deg = is_poor ? 1.5 : 0.2;
        const double off_px = off_deg * geometry.px_per_deg_at_centre();
        REQUIRE(screen.kind == Screen::Kind::validation);
        REQUIRE(screen.validated.size() >= 8);
        REQUIRE(screen.validated.size() % 2 == 0);
        for (std::size_t i = 0; i < screen.validated.size(); ++i) {
            const ValidatedTarget& target = screen.validated[i];
            CHECK(target.eye == (i % 2 == 0 ? Eye::left : Eye::right));
            if (i % 2 == 1) {
                CHECK(target.target.x_px == screen.validated[i - 1].target.x_px);
                CHECK(target.target.y_px == screen.validated[i - 1].target.y_px);
            }
            const bool is_missed = is_poor && i + 1 == screen.validated.size();
            REQUIRE(target.gaze.has_value() == !is_missed);
            if (is_missed)
                continue;
            const double right = target.gaze->x_px - target.target.x_px;
            const double down = target.gaze->y_px - target.target.y_px;
            CHECK(std::hypot(right, down) == Approx(off_px));
            CHECK(std::remainder(std::atan2(down, right) - (0.7 + 2.4 * static_cast<double>(i)),
                                 2.0 * std::numbers::pi) == Approx(0.0).margin(1e-6));
        }
        // By the tangent, a little less away from the middle of the screen.
        double mean_deg = 0.0, largest_deg = 0.0;
        CHECK(std::sscanf(screen.text.c_str() + screen.text.rfind('\n') + 1, "%lf° (%lf°)", &mean_deg,
                          &largest_deg) == 2);
        CHECK(mean_deg <= largest_deg);
        CHECK(mean_deg == Approx(off_deg).epsilon(0.1));
        CHECK(largest_deg == Approx(off_deg).epsilon(0.1));
        CHECK(screen.text.starts_with(is_poor ? protocol.words.validation_poor : protocol.words.validation));
    }
}

TEST_CASE("an answer's screen has the task's question where no answer has one, or always", "[unit]") {
    Protocol protocol = short_protocol("");
    AnswerView view;
    view.items.resize(2);
    CHECK(screens::answers(protocol, 0, view).text == "Look.");
    view.items[1].question = "How?";
    CHECK(screens::answers(protocol, 0, view).text.empty());
    protocol.screens.repeat_question = true;
    CHECK(screens::answers(protocol, 0, view).text == "Look.");
    CHECK(screens::answers(protocol, 0, view).answers.items.size() == 2);
    CHECK(screens::answers(protocol, 0, view).kind == Screen::Kind::answers);
}

TEST_CASE("words and colours of feedback are by whether it was answered, and rightly", "[unit]") {
    const Protocol protocol = short_protocol("");
    const Trial trial;
    StepSettings settings;
    settings.answered = "Thanks";
    settings.missed = "Late";
    settings.correct = "Right";
    settings.wrong = "Wrong";
    PlannedStep step{.settings = &settings, .kind = StepKind::feedback};
    using Colour = AnswerItem::Colour;
    struct Case {
        bool is_answered;
        std::optional<bool> is_correct;
        std::string words, without;
        Colour colour;
        Beep tone;
    };
    const Case cases[] = {{true, {}, "Thanks", "Thanks", Colour::plain, Beep::answered},
                          {true, true, "Right", "Thanks", Colour::good, Beep::correct},
                          {true, false, "Wrong", "Thanks", Colour::bad, Beep::wrong},
                          {false, {}, "Late", "Late", Colour::bad, Beep::missed}};
    for (const Case& each : cases) {
        CAPTURE(each.words);
        StepCircumstances of{.protocol = protocol, .trial = trial};
        of.is_answered = each.is_answered;
        of.is_correct = each.is_correct;
        CHECK(screen_of(step, of).text == each.words);
        CHECK(screen_of(step, of).kind == Screen::Kind::text);
        StepSettings plain = settings;
        plain.correct.clear();
        plain.wrong.clear();
        CHECK(screen_of({.settings = &plain, .kind = StepKind::feedback}, of).text == each.without);
        StepSettings coloured = settings;
        coloured.is_coloured = true;
        const Screen screen = screen_of({.settings = &coloured, .kind = StepKind::feedback}, of);
        CHECK(screen.kind == Screen::Kind::answers);
        REQUIRE(screen.answers.items.size() == 1);
        CHECK(screen.answers.items[0].kind == AnswerItem::Kind::notice);
        CHECK(screen.answers.items[0].question == each.words);
        CHECK(screen.answers.items[0].colour == each.colour);
        CHECK_FALSE(tone_of(settings, of));
        coloured.has_tone = true;
        CHECK(tone_of(coloured, of) == each.tone);
    }
    settings.missed.clear();
    CHECK(screen_of(step, {.protocol = protocol, .trial = trial}).kind == Screen::Kind::blank);
}

TEST_CASE("a fixation's target stands by the tangent of its angles, up is up, and others in the middle",
          "[unit]") {
    const Protocol protocol = short_protocol("");
    const ScreenGeometry screen = screen_geometry_of(protocol);
    StepSettings settings;
    settings.right_deg = 6.0;
    settings.up_deg = -2.5;
    const ScreenPoint at = target_of(settings, screen);
    const double mm_x = screen.screen_mm.x / screen.screen_px.x,
                 mm_y = screen.screen_mm.y / screen.screen_px.y;
    CHECK((at.x_px - 0.5 * screen.screen_px.x) * mm_x ==
          Approx(screen.viewing_distance_mm * std::tan(6.0 * std::numbers::pi / 180.0)));
    CHECK((at.y_px - 0.5 * screen.screen_px.y) * mm_y ==
          Approx(screen.viewing_distance_mm * std::tan(2.5 * std::numbers::pi / 180.0)));
    const Trial trial;
    const StepCircumstances of{.protocol = protocol, .trial = trial};
    PlannedStep step{.settings = &settings, .kind = StepKind::fixation};
    CHECK(screen_of(step, of).kind == Screen::Kind::target);
    REQUIRE(screen_of(step, of).target_place);
    CHECK(screen_of(step, of).target_place->x_px == at.x_px);
    for (double* const angle : {&settings.right_deg, &settings.up_deg}) {
        *angle = 0.0;
        CHECK(screen_of(step, of).target_place.has_value() == (angle == &settings.right_deg));
    }
    step.kind = StepKind::blank;
    CHECK(screen_of(step, of).kind == Screen::Kind::blank);
}

TEST_CASE("a text's words stand for the trial's as often as they occur, and a key ends it where no time does",
          "[unit]") {
    Protocol protocol = short_protocol("");
    protocol.objects.front().title = "Muse";
    Trial trial;
    trial.stimulus.material = 1;
    protocol.materials[1].title = "Clay";
    StepSettings settings;
    settings.text = "{object} or {object}? {question}{material}";
    PlannedStep step{.settings = &settings, .kind = StepKind::text};
    const StepCircumstances of{.protocol = protocol, .trial = trial};
    CHECK(screen_of(step, of).text == "Muse or Muse? Look.Clay");
    CHECK(screen_of(step, of).keys.size() == 1);
    step.refreshes = 60;
    CHECK(screen_of(step, of).keys.empty());
}

TEST_CASE("the noise of a mask is the step's own in each trial, and covers what was shown", "[unit]") {
    const Protocol protocol = short_protocol("");
    StepSettings settings;
    settings.cell_deg = 0.4;
    PlannedStep step{.settings = &settings, .kind = StepKind::mask, .places = {0, 2}};
    const auto noise = [&](std::uint64_t seed, std::size_t number, int index) {
        Trial trial;
        trial.index = index;
        return screen_of(step, {.protocol = protocol, .trial = trial, .seed = seed, .number = number});
    };
    const Screen screen = noise(1, 2, 3);
    CHECK(screen.kind == Screen::Kind::noise);
    CHECK(screen.noise_cell.value == 0.4);
    CHECK(screen.places == std::vector<int>{0, 2});
    CHECK(screen.noise_seed == noise(1, 2, 3).noise_seed);
    CHECK(screen.noise_seed != noise(2, 2, 3).noise_seed);
    CHECK(screen.noise_seed != noise(1, 3, 3).noise_seed);
    CHECK(screen.noise_seed != noise(1, 2, 4).noise_seed);
    CHECK(screen.noise_seed != noise(1, 3, 2).noise_seed);
    // All 64 bits are drawn.
    std::uint64_t ones = 0, zeros = 0;
    for (int i = 0; i < 64; ++i) {
        ones |= noise(1, 2, i).noise_seed;
        zeros |= ~noise(1, 2, i).noise_seed;
    }
    CHECK(ones == ~std::uint64_t{0});
    CHECK(zeros == ~std::uint64_t{0});
    settings.is_scrambled = true;
    CHECK(noise(1, 2, 3).kind == Screen::Kind::scrambled);
    step.places.clear();
    CHECK(noise(1, 2, 3).kind == Screen::Kind::blank);
}

TEST_CASE("a screen for speaking is there where an answer is spoken", "[unit]") {
    const auto speaks = [](const std::string& answers) {
        Protocol protocol = short_protocol("[[task]]\nid = \"t\"\nquestion = \"Which?\"\n" + answers +
                                           "[[block]]\nid = \"b\"\ntasks = \"t\"\n");
        protocol.tasks.erase(protocol.tasks.begin()); // the other one speaks
        const auto all = screens::all_of(protocol);
        return std::ranges::any_of(all, [](const auto& each) { return each.first == "response"; });
    };
    CHECK(speaks(""));
    CHECK(speaks("[[task.answer]]\nid = \"s\"\nkind = \"spoken\"\n"));
    CHECK_FALSE(speaks(
        "[[task.answer]]\nid = \"c\"\nkind = \"choice\"\nchoices = [\"x\", \"y\"]\nkeys = [\"f\", \"j\"]\n"));
}
