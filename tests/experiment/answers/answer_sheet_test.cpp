/// Windows, keys and marks: which press answers, and what is recorded of all others.
#include "experiment/answers/answer_sheet.h"

#include <catch2/catch.hpp>

#include "experiment/answers/answer_kinds.h"

using namespace overt;

namespace {

SessionTime at_ms(double ms) { return SessionTime() + from_seconds(1e-3 * ms); }

ObserverInput key_at(double ms, std::string_view key,
                     ObserverInput::Kind kind = ObserverInput::Kind::key_down) {
    ObserverInput input;
    input.kind = kind;
    input.at = at_ms(ms);
    input.device = ShortName("keyboard");
    input.key = ShortName(key);
    return input;
}
ObserverInput up_at(double ms, std::string_view key) { return key_at(ms, key, ObserverInput::Kind::key_up); }
ObserverInput mouse_at(double ms, ObserverInput::Kind kind) {
    ObserverInput input;
    input.kind = kind;
    input.at = at_ms(ms);
    input.button = 1;
    return input;
}
ObserverInput written_at(double ms, char32_t character) {
    ObserverInput input;
    input.kind = ObserverInput::Kind::text;
    input.at = at_ms(ms);
    input.character = character;
    return input;
}

TaskAnswer two_choices() {
    TaskAnswer answer;
    answer.id = "which";
    answer.kind = kind_called<AnswerKind>("choice");
    answer.choices = {"left", "right"};
    answer.keys = {"f", "j"};
    return answer;
}
TaskAnswer scale_of(std::optional<int> steps) {
    TaskAnswer answer;
    answer.id = "gloss";
    answer.kind = kind_called<AnswerKind>("scale");
    answer.steps = steps;
    return answer;
}

AnswerForm form_of(const TaskAnswer& answer, int mapping = 0, std::string item = {}) {
    return {.settings = &answer,
            .item = std::move(item),
            .labels = answer.choices.empty() ? answer.keys : answer.choices,
            .mapping = mapping,
            .correct = {},
            .place = 0};
}

/// Its rows.
struct SheetRows {
    explicit SheetRows(const AnswerSheet& sheet) { sheet.add_to(given, inputs); }
    std::vector<GivenAnswer> given;
    std::vector<AnswerInput> inputs;
};

} // namespace

TEST_CASE("a press a refresh before the window is recorded as before, and one after it answers", "[unit]") {
    const TaskAnswer answer = two_choices();
    AnswerSheet sheet({form_of(answer)}, true);
    constexpr double refresh_ms = 1000.0 / 120.0;
    sheet.take(key_at(500.0 - refresh_ms, "f"), {});
    sheet.stimulus_lit(at_ms(500.0));
    sheet.take(up_at(510.0, "f"), {});
    CHECK_FALSE(sheet.is_complete());
    sheet.take(key_at(500.0 + refresh_ms, "j"), {});
    CHECK(sheet.is_complete());
    CHECK(sheet.ends_stimulus_at() == at_ms(500.0 + refresh_ms));
    const SheetRows rows(sheet);
    REQUIRE(rows.given.size() == 1);
    CHECK(rows.given[0].value == "right");
    CHECK(rows.given[0].key == "j");
    CHECK(rows.given[0].zero == AnswerZero::stimulus);
    CHECK(to_seconds(*rows.given[0].response_time()) == Approx(refresh_ms / 1000.0));
    REQUIRE(rows.inputs.size() == 3);
    CHECK(rows.inputs[0].state == InputState::before);
    CHECK_FALSE(rows.inputs[0].has_counted);
    CHECK(rows.inputs[2].state == InputState::open);
    CHECK(rows.inputs[2].has_counted);
}

TEST_CASE("a key that was held since before the window never answers until it was let go", "[unit]") {
    const TaskAnswer answer = two_choices();
    AnswerSheet sheet({form_of(answer)}, false);
    sheet.take(key_at(100, "f"), {});
    sheet.screen_lit(at_ms(200));
    sheet.take(key_at(300, "f"), {}); // repeats while it is held
    CHECK_FALSE(sheet.is_complete());
    SECTION("let go") { sheet.take(up_at(320, "f"), {}); }
    SECTION("the keyboard went to another window") {
        sheet.take(key_at(320, "", ObserverInput::Kind::let_go), {});
    }
    sheet.take(key_at(400, "f"), {});
    CHECK(sheet.is_complete());
    CHECK(SheetRows(sheet).given[0].answered_at == at_ms(400));
}

TEST_CASE("after the window has closed a press is late, and what was missed is not wrong", "[unit]") {
    TaskAnswer answer = two_choices();
    answer.limit_s = 0.5;
    AnswerForm form = form_of(answer);
    form.correct = "left";
    AnswerSheet sheet({form}, false);
    sheet.screen_lit(at_ms(1000));
    CHECK_FALSE(sheet.is_over_at(at_ms(1500)));
    CHECK(sheet.is_over_at(at_ms(1501)) == at_ms(1500));
    sheet.take(key_at(1600, "f"), {});
    const SheetRows rows(sheet);
    CHECK(rows.inputs[0].state == InputState::late);
    CHECK(rows.given[0].is_missed);
    CHECK_FALSE(rows.given[0].is_correct);
    CHECK_FALSE(rows.given[0].response_time());
    answer.missed = MissedAnswer::wrong;
    CHECK(SheetRows(sheet).given[0].is_correct == false);
}

TEST_CASE("of two keys at one time the tie is told, of two at different times the first counts", "[unit]") {
    const TaskAnswer answer = two_choices();
    const double second_ms = GENERATE(700.0, 701.0);
    AnswerSheet sheet({form_of(answer)}, false);
    sheet.screen_lit(at_ms(500));
    sheet.take(key_at(700.0, "j"), {});
    sheet.take(key_at(second_ms, "f"), {});
    const SheetRows rows(sheet);
    CHECK(rows.given[0].value == "right");
    CHECK(rows.given[0].is_tied == (second_ms == 700.0));
}

TEST_CASE("choices go round over the keys, which are recorded with what they meant", "[unit]") {
    const TaskAnswer answer = two_choices();
    const int mapping = GENERATE(0, 1);
    AnswerSheet sheet({form_of(answer, mapping)}, false);
    sheet.screen_lit(at_ms(0));
    const AnswerView view = sheet.view("go on");
    CHECK(view.items[0].options[0].key == "f");
    CHECK(view.items[0].options[0].label == (mapping == 0 ? "left" : "right"));
    CHECK(view.accept.empty());
    sheet.take(key_at(10, "f"), {});
    const SheetRows rows(sheet);
    CHECK(rows.given[0].value == view.items[0].options[0].label);
    CHECK(rows.given[0].key == "f");
    CHECK(rows.given[0].mapping == mapping);
}

TEST_CASE("where the last press counts, what was chosen can be changed until the window closes", "[unit]") {
    TaskAnswer answer = two_choices();
    answer.counts = AnswerCounts::last;
    answer.ends_step = false;
    answer.limit_s = 1.0;
    AnswerSheet sheet({form_of(answer)}, false);
    sheet.screen_lit(at_ms(0));
    for (const auto& [ms, key] : {std::pair(100.0, "f"), {300.0, "j"}, {500.0, "f"}, {1200.0, "j"}}) {
        sheet.take(key_at(ms, key), {});
        sheet.take(up_at(ms + 50, key), {});
    }
    const SheetRows rows(sheet);
    CHECK(rows.given[0].value == "left");
    CHECK(rows.given[0].answered_at == at_ms(500));
    CHECK(rows.given[0].first_input_at == at_ms(100));
    CHECK(rows.given[0].changes == 3);
    CHECK(sheet.is_over_at(at_ms(1001)) == at_ms(1000));
}

TEST_CASE("a marker is not there until the first press, and says nothing until it was moved", "[unit]") {
    const TaskAnswer answer = scale_of({});
    AnswerSheet sheet({form_of(answer)}, false);
    sheet.screen_lit(at_ms(0));
    CHECK_FALSE(sheet.view("ok").items[0].marker);
    sheet.take(key_at(50, "enter"), {});
    sheet.take(up_at(60, "enter"), {});
    double ms = 100;
    const auto press = [&](std::string_view key) {
        sheet.take(key_at(ms, key), {});
        sheet.take(up_at(ms + 20, key), {});
        ms += 50;
    };
    press("right");
    CHECK(sheet.view("ok").items[0].marker == 0.5);
    CHECK_FALSE(sheet.view("ok").can_accept);
    press("enter");
    CHECK_FALSE(sheet.is_complete());
    press("right");
    press("left");
    press("enter");
    CHECK(sheet.is_complete());
    const GivenAnswer given = SheetRows(sheet).given[0];
    CHECK(given.number == 50.0);
    CHECK(given.value == "50");
    CHECK(given.key == "enter");
    CHECK(given.answered_at == at_ms(300));
    CHECK(given.first_input_at == at_ms(100));
}

TEST_CASE("a scale that is turned round shows the other side, and means the same", "[unit]") {
    const TaskAnswer answer = scale_of(7);
    const int mapping = GENERATE(0, 1);
    AnswerSheet sheet({form_of(answer, mapping)}, false);
    sheet.screen_lit(at_ms(0));
    const AnswerItem item = sheet.view("ok").items[0];
    REQUIRE(item.options.size() == 7);
    CHECK(item.options.front().key == (mapping == 0 ? "1" : "7"));
    sheet.take(key_at(10, "2"), {});
    CHECK(sheet.view("ok").items[0].options[mapping == 0 ? 1 : 5].is_chosen);
    sheet.take(key_at(20, "right"), {}); // to the right on the screen
    sheet.take(key_at(30, "enter"), {});
    CHECK(SheetRows(sheet).given[0].number == (mapping == 0 ? 3.0 : 1.0));
}

TEST_CASE("a click is down and up inside one step, on one choice", "[unit]") {
    using Kind = ObserverInput::Kind;
    TaskAnswer answer = two_choices();
    answer.with = AnsweredWith::mouse;
    AnswerSheet sheet({form_of(answer)}, false);
    const AnswerPlace left{.item = 0, .option = 0}, right{.item = 0, .option = 1};
    sheet.screen_lit(at_ms(0));
    sheet.take(mouse_at(10, Kind::pointer_down), left);
    sheet.begin_step();
    sheet.take(mouse_at(20, Kind::pointer_up), left);
    CHECK_FALSE(sheet.is_complete());
    sheet.take(mouse_at(30, Kind::pointer_down), left);
    sheet.take(mouse_at(40, Kind::pointer_up), right);
    CHECK_FALSE(sheet.is_complete());
    sheet.take(key_at(45, "f"), {}); // keys are not asked for
    CHECK_FALSE(sheet.is_complete());
    sheet.take(mouse_at(50, Kind::pointer_down), right);
    sheet.take(mouse_at(60, Kind::pointer_up), right);
    CHECK(sheet.is_complete());
    CHECK(SheetRows(sheet).given[0].value == "right");
}

TEST_CASE("items of a scale are answered in turn, page by page, each with a row and times of its own",
          "[unit]") {
    TaskAnswer answer = scale_of(5);
    answer.accept = AnswerAccept::at_once;
    answer.per_screen = 2;
    AnswerSheet sheet({form_of(answer, 0, "gloss"), form_of(answer, 0, "colour"), form_of(answer, 0, "cold")},
                      false);
    sheet.screen_lit(at_ms(0));
    CHECK(sheet.view("ok").items.size() == 2);
    sheet.take(key_at(100, "4"), {});
    CHECK(sheet.view("ok").items[1].is_here);
    sheet.take(key_at(200, "2"), {});
    CHECK(sheet.page() == 1);
    // The next page is not on the screen yet.
    sheet.take(key_at(205, "5"), {});
    CHECK_FALSE(sheet.is_complete());
    sheet.take(up_at(206, "5"), {});
    sheet.screen_lit(at_ms(210));
    sheet.take(key_at(300, "5"), {});
    CHECK(sheet.is_complete());
    const SheetRows rows(sheet);
    REQUIRE(rows.given.size() == 3);
    CHECK(rows.given[0].number == 4.0);
    CHECK(rows.given[1].number == 2.0);
    CHECK(rows.given[2].number == 5.0);
    CHECK(rows.given[2].item == "cold");
    CHECK(rows.given[2].screen_onset == at_ms(210));
    CHECK(rows.given[2].response_time() == from_seconds(0.09));
}

TEST_CASE("numbers are kept to their range and grid, and take a comma", "[unit]") {
    TaskAnswer answer;
    answer.id = "age";
    answer.kind = kind_called<AnswerKind>("number");
    answer.min = 0;
    answer.max = 120;
    answer.step = 0.5;
    AnswerSheet sheet({form_of(answer)}, false);
    sheet.screen_lit(at_ms(0));
    for (const char32_t character : U"12x1,5")
        sheet.take(written_at(10, character), {});
    CHECK(sheet.view("ok").items[0].typed.starts_with("121,5"));
    sheet.take(key_at(20, "enter"), {});
    CHECK_FALSE(sheet.is_complete());
    CHECK_FALSE(sheet.view("ok").items[0].message.empty());
    for (int i = 0; i < 3; ++i) {
        sheet.take(key_at(30 + 2 * i, "backspace"), {});
        sheet.take(up_at(31 + 2 * i, "backspace"), {});
    }
    sheet.take(up_at(40, "enter"), {});
    sheet.take(key_at(50, "enter"), {});
    REQUIRE(sheet.is_complete());
    CHECK(SheetRows(sheet).given[0].number == 12.0);
}

TEST_CASE("what is not required can be passed over, and is missed then", "[unit]") {
    TaskAnswer answer;
    answer.id = "remarks";
    answer.kind = kind_called<AnswerKind>("text");
    answer.is_required = GENERATE(true, false);
    AnswerSheet sheet({form_of(answer)}, false);
    sheet.screen_lit(at_ms(0));
    sheet.take(key_at(10, "enter"), {});
    CHECK(sheet.is_complete() != answer.is_required);
    CHECK(SheetRows(sheet).given[0].is_missed);
    if (answer.is_required) {
        for (const char32_t character : {U'h', U'é', U'!'})
            sheet.take(written_at(20, character), {});
        sheet.take(key_at(30, "backspace"), {});
        sheet.take(written_at(31, U'?'), {});
        sheet.take(written_at(32, U'!'), {});
        // Held, it erases on.
        sheet.take(written_at(34, U'\b'), {});
        sheet.take(written_at(36, U'\b'), {});
        sheet.take(up_at(40, "enter"), {});
        sheet.take(key_at(50, "enter"), {});
        CHECK(SheetRows(sheet).given[0].value == "hé");
    }
}

TEST_CASE("a point is where the left button went down on the stimulus, once that is there", "[unit]") {
    TaskAnswer answer;
    answer.id = "where";
    answer.kind = kind_called<AnswerKind>("point");
    AnswerSheet sheet({form_of(answer)}, true);
    CHECK(sheet.points());
    CHECK(sheet.view("").shows_pointer);
    const auto down_at = [](double ms, double right_px, int button) {
        ObserverInput input = mouse_at(ms, ObserverInput::Kind::pointer_down);
        input.right_px = right_px;
        input.down_px = -7.25;
        input.button = button;
        return input;
    };
    sheet.take(down_at(90, 1.0, 1), {});
    sheet.take(mouse_at(95, ObserverInput::Kind::pointer_up), {});
    sheet.stimulus_lit(at_ms(100));
    sheet.take(down_at(150, 2.0, 3), {});
    CHECK_FALSE(sheet.is_complete());
    sheet.take(mouse_at(160, ObserverInput::Kind::pointer_up), {});
    sheet.take(down_at(200, 31.5, 1), {});
    CHECK(sheet.ends_stimulus_at() == at_ms(200));
    const SheetRows rows(sheet);
    CHECK(rows.given[0].value == "31.500 -7.250");
    CHECK(rows.inputs[0].state == InputState::before);
    const TaskAnswer by_keys = two_choices();
    CHECK_FALSE(AnswerSheet({form_of(by_keys)}, true).view("").shows_pointer);
}

TEST_CASE("a click that leaves the window, or whose window loses the keyboard, chooses nothing", "[unit]") {
    using Kind = ObserverInput::Kind;
    TaskAnswer answer = two_choices();
    answer.with = AnsweredWith::mouse;
    AnswerSheet sheet({form_of(answer)}, false);
    const AnswerPlace left{.item = 0, .option = 0};
    sheet.screen_lit(at_ms(0));
    // Down on a choice, and up beside the screen.
    sheet.take(mouse_at(10, Kind::pointer_down), left);
    sheet.take(mouse_at(15, Kind::pointer_moved), {});
    sheet.take(mouse_at(20, Kind::pointer_up), {});
    CHECK_FALSE(sheet.is_complete());
    // Down beside it, and up on a choice.
    sheet.take(mouse_at(30, Kind::pointer_down), {});
    sheet.take(mouse_at(40, Kind::pointer_up), left);
    CHECK_FALSE(sheet.is_complete());
    // Another window came in between.
    sheet.take(mouse_at(50, Kind::pointer_down), left);
    sheet.take(key_at(55, "", Kind::let_go), {});
    sheet.take(mouse_at(60, Kind::pointer_up), left);
    CHECK_FALSE(sheet.is_complete());
    sheet.take(mouse_at(70, Kind::pointer_down), left);
    sheet.take(mouse_at(80, Kind::pointer_up), left);
    CHECK(sheet.is_complete());
    CHECK(SheetRows(sheet).given[0].answered_at == at_ms(80));
}

TEST_CASE("what was typed outlasts another window, and is of any script", "[unit]") {
    TaskAnswer answer;
    answer.id = "word";
    answer.kind = kind_called<AnswerKind>("text");
    answer.longest = 5;
    AnswerSheet sheet({form_of(answer)}, false);
    // Before the screen nothing is written.
    sheet.take(written_at(5, U'x'), {});
    sheet.screen_lit(at_ms(10));
    for (const char32_t character : U"ô漢")
        if (character != 0)
            sheet.take(written_at(20, character), {});
    sheet.take(key_at(30, "", ObserverInput::Kind::let_go), {});
    // A letter and its accent for themselves, a tab, and one outside of the basic plane; then one too many.
    for (const char32_t character : {char32_t{'e'}, char32_t{0x301}, char32_t{'\t'}, char32_t{0x1F600}, U'z'})
        sheet.take(written_at(40, character), {});
    CHECK(sheet.view("ok").items[0].typed == "ô漢e\xCC\x81\xF0\x9F\x98\x80");
    // One character at a time is taken back, however many bytes it has.
    for (const double ms : {50.0, 60.0}) {
        sheet.take(key_at(ms, "backspace"), {});
        sheet.take(up_at(ms + 5, "backspace"), {});
    }
    sheet.take(key_at(70, "enter"), {});
    CHECK(SheetRows(sheet).given[0].value == "ô漢e");
    CHECK(SheetRows(sheet).inputs.front().state == InputState::before);
}
