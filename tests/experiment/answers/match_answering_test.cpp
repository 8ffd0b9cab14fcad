/// Settings of matches: what keys and the wheel do, where levels end, and what is recorded.
#include "experiment/answers/answer_kinds.h"

#include <catch2/catch.hpp>

#include "experiment/answers/answer_sheet.h"

using namespace overt;

namespace {

TaskAnswer match_along(std::vector<std::string> along) {
    TaskAnswer answer;
    answer.id = "gloss";
    answer.kind = kind_called<AnswerKind>("match");
    answer.slot = "reference";
    answer.along = std::move(along);
    answer.coarse_steps = 3;
    return answer;
}

AnswerForm match_form(const TaskAnswer& settings, std::vector<MatchLevels::Axis> axes) {
    AnswerForm form;
    form.settings = &settings;
    form.levels.axes = std::move(axes);
    std::size_t count = 1;
    for (const MatchLevels::Axis& axis : form.levels.axes)
        count *= axis.values.size();
    for (std::size_t i = 0; i < count; ++i)
        form.levels.stimuli.push_back({.object = 0, .material = static_cast<int>(i)});
    form.levels.place = 1;
    form.levels.slot = 1;
    return form;
}

ObserverInput match_pressed(std::string_view key) {
    ObserverInput input;
    input.key = ShortName(key);
    return input;
}

ObserverInput turned_wheel(double steps) {
    ObserverInput input;
    input.kind = ObserverInput::Kind::wheel;
    input.steps = steps;
    return input;
}

using MatchEffect = Answering::Effect;

} // namespace

TEST_CASE("a match goes from level to level, and counts changes, reversals and ends", "[unit]") {
    const TaskAnswer settings = match_along({"roughness"});
    const auto match =
        match_answering(match_form(settings, {{"roughness", {0.1, 0.2, 0.3, 0.4, 0.5}, 2, 0.25}}));
    const auto press = [&](std::string_view key) { return match->take(match_pressed(key), {}); };
    CHECK(match->has_value());
    CHECK(match->level() == 2);
    CHECK(press("right") == MatchEffect::changed);     // 3
    CHECK(press("page up") == MatchEffect::changed);   // 4, and stopped
    CHECK(press("right") == MatchEffect::none);        // stopped
    CHECK(press("left") == MatchEffect::changed);      // 3, back
    CHECK(press("page down") == MatchEffect::changed); // 0
    CHECK(press("left") == MatchEffect::none);
    CHECK(press("backspace") == MatchEffect::changed); // 3, back again
    CHECK(press("x") == MatchEffect::none);
    CHECK(match->take(turned_wheel(1.0), {}) == MatchEffect::none); // it is not set with the mouse
    CHECK(match->level() == 3);
    CHECK(match->number() == 0.4);
    CHECK(match->value() == "0.4");
    GivenAnswer given;
    match->add_details(given);
    REQUIRE(given.settings.size() == 1);
    CHECK(given.settings.front() == MatchSetting{"roughness", 0.3, 0.4, 0.1, 0.5, 0.25, 5, 2, 1, 2});
    CHECK(given.slot == 1);
    REQUIRE(given.levels.size() == 5);
    CHECK(given.levels[4] == MatchLevel{4, {.object = 0, .material = 4}, {0.5}});
}

TEST_CASE("all changes can be taken back one by one, and none beyond the first", "[unit]") {
    const TaskAnswer settings = match_along({"roughness"});
    const auto match = match_answering(match_form(settings, {{"roughness", {1, 2, 3, 4}, 0, {}}}));
    for (const std::string_view key : {"right", "right", "right"})
        match->take(match_pressed(key), {});
    CHECK(match->level() == 3);
    for (int left = 2; left >= 0; --left) {
        CHECK(match->take(match_pressed("backspace"), {}) == MatchEffect::changed);
        CHECK(match->level() == left);
    }
    CHECK(match->take(match_pressed("backspace"), {}) == MatchEffect::none);
}

TEST_CASE("along two columns each key goes along its own, and the second runs faster", "[unit]") {
    TaskAnswer settings = match_along({"roughness", "lightness"});
    settings.with = AnsweredWith::both;
    const auto match = match_answering(
        match_form(settings, {{"roughness", {0.1, 0.2, 0.3}, 1, {}}, {"lightness", {10, 20}, 0, {}}}));
    CHECK(match->level() == 2);
    match->take(match_pressed("up"), {});
    CHECK(match->level() == 3);
    match->take(match_pressed("right"), {});
    CHECK(match->level() == 5);
    CHECK(match->value() == "0.3 20");
    match->take(turned_wheel(-2.0), {});
    CHECK(match->level() == 1);
    match->take(match_pressed("page up"), {}); // no coarse keys of its own
    CHECK(match->level() == 1);
    GivenAnswer given;
    match->add_details(given);
    REQUIRE(given.settings.size() == 2);
    CHECK(given.settings[0].changes == 2);
    CHECK(given.settings[0].reversals == 1);
    CHECK(given.settings[1].final == 20.0);
    CHECK_FALSE(given.settings[1].reference);
    CHECK(given.levels[3].values == std::vector<double>{0.2, 20.0});
}

TEST_CASE("a sheet tells the level of a place and the input that set it, and stands until it is accepted",
          "[unit]") {
    const TaskAnswer settings = match_along({"roughness"});
    AnswerSheet sheet({match_form(settings, {{"roughness", {1, 2, 3}, 1, {}}})}, true);
    const auto at = [](double ms, std::string_view key) {
        ObserverInput input = match_pressed(key);
        input.at = SessionTime() + from_seconds(1e-3 * ms);
        return input;
    };
    CHECK_FALSE(sheet.level_of(0));
    REQUIRE(sheet.level_of(1));
    CHECK(sheet.level_of(1)->level == 1);
    CHECK_FALSE(sheet.level_of(1)->input_at);
    sheet.take(at(50, "right"), {}); // before the window
    CHECK(sheet.level_of(1)->level == 1);
    sheet.stimulus_lit(SessionTime() + from_seconds(0.1));
    ObserverInput up = at(60, "right");
    up.kind = ObserverInput::Kind::key_up;
    sheet.take(up, {});
    sheet.take(at(200, "right"), {});
    CHECK(sheet.level_of(1)->level == 2);
    CHECK(sheet.level_of(1)->input_at == SessionTime() + from_seconds(0.2));
    CHECK_FALSE(sheet.ends_stimulus_at());
    sheet.take(at(300, "enter"), {});
    CHECK(sheet.ends_stimulus_at() == SessionTime() + from_seconds(0.3));
    std::vector<GivenAnswer> given;
    std::vector<AnswerInput> inputs;
    sheet.add_to(given, inputs);
    REQUIRE(given.size() == 1);
    CHECK(given.front().value == "3");
    CHECK(given.front().settings.size() == 1);
    CHECK(given.front().changes == 1);
}
