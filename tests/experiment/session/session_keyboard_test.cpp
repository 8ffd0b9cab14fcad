/// A keyboard that another window takes, and how well the time of a press is known.
#include "tests/experiment/record/plain_session.h"

using namespace overt;
using namespace overt::test;
using Pressed = ResponsePress::Key;

namespace {

/// The pause before the second of two trials lasts until the keyboard comes back.
constexpr int looks_without = 20;

/// It goes where `goes` says, once, and comes back after a while of saying so. Gives whether it is back.
std::shared_ptr<bool> lose_keyboard(Sitting& sitting, std::function<bool(const ScriptedPanel&)> goes) {
    const auto is_back = std::make_shared<bool>(false);
    sitting.panel.lacks_keyboard = [&sitting, goes = std::move(goes), is_away = false,
                                    is_back](const ScriptedPanel& panel) mutable {
        is_away = is_away || (!*is_back && goes(panel));
        // A while that is longer than an answer may take.
        if (is_away && panel.phase() == SessionPhase::pause)
            sitting.clock.wait_until(sitting.clock.now() + std::chrono::milliseconds(400));
        if (is_away && panel.phase() == SessionPhase::pause && panel.looks >= looks_without) {
            is_away = false;
            *is_back = true;
        }
        return is_away;
    };
    return is_back;
}

} // namespace

TEST_CASE("while another window has the keyboard no trial begins, and the screen says why", "[unit]") {
    Sitting sitting(short_protocol("[words]\nkeyboard_lost = \"Click here.\"\n"));
    // It goes in the first trial, which is not broken off for it.
    lose_keyboard(sitting, [](const ScriptedPanel& panel) { return panel.trial == 0; });
    CHECK(sitting.run().completed_trials == 2);
    CHECK(std::ranges::count(sitting.presenter.texts, "Click here.") == 1);
    CHECK(sitting.panel.times_in(SessionPhase::pause) == 1);
    // None of the keys that a box pressed meanwhile ended it.
    CHECK(sitting.log.completed == std::vector<bool>{true, true});
}

TEST_CASE("a keyboard that goes is told of on whatever screen waits for a key, and time waits", "[unit]") {
    Sitting sitting(short_protocol("[words]\nkeyboard_lost = \"Click here.\"\n"
                                   "[screens]\nresponse_max_s = 5\nwelcome_text = \"Welcome.\"\n"));
    SessionPhase where = SessionPhase::response_screen;
    SECTION("the welcome") { where = SessionPhase::set_up; }
    SECTION("a trial's question") { where = SessionPhase::task_screen; }
    SECTION("a trial's answer") {}
    const auto is_back =
        lose_keyboard(sitting, [&](const ScriptedPanel& panel) { return panel.phase() == where; });
    // The observer goes on once the keyboard is back.
    sitting.panel.tell = [&](ScriptedPanel& panel) -> std::optional<ResponsePress> {
        return panel.phase() == where && !*is_back ? std::optional(ResponsePress{Pressed::up, {}})
                                                   : std::nullopt;
    };
    CHECK(sitting.run().completed_trials == 2);
    REQUIRE(std::ranges::count(sitting.presenter.texts, "Click here.") == 1);
    CHECK(sitting.panel.times_in(SessionPhase::pause) == 1);
    // More than response_max_s went by without it.
    CHECK(sitting.log.count(response_timed_out_event) == 0);
}

TEST_CASE("the session can be ended while the keyboard is away", "[unit]") {
    Sitting sitting(short_protocol(""));
    sitting.panel.lacks_keyboard = [](const ScriptedPanel& panel) { return panel.trial == 0; };
    sitting.panel.tell = [](ScriptedPanel& panel) -> std::optional<ResponsePress> {
        if (panel.phase() == SessionPhase::pause && !panel.is_deciding() && panel.looks > 3)
            return ResponsePress{Pressed::abort, {}};
        return std::nullopt;
    };
    const SessionResult result = sitting.run();
    CHECK(result.aborted);
    CHECK(result.completed_trials == 0);
}

TEST_CASE("an answer has the uncertainty of the press that gave it, and the next trial its own", "[unit]") {
    Sitting sitting(short_protocol(""));
    sitting.panel.tell = [](ScriptedPanel& panel) -> std::optional<ResponsePress> {
        if (panel.phase() != SessionPhase::response_screen || panel.trial != 0)
            return std::nullopt;
        ResponsePress press{Pressed::next, {}};
        press.uncertainty = std::chrono::milliseconds(4);
        return press;
    };
    sitting.run();
    REQUIRE(sitting.log.outcomes.size() == 2);
    CHECK(sitting.log.outcomes[0].responded_uncertainty == SessionDuration(std::chrono::milliseconds(4)));
    CHECK_FALSE(sitting.log.outcomes[1].responded_uncertainty);
}

TEST_CASE("a keyboard that goes a second time is told of a second time", "[unit]") {
    Sitting sitting(short_protocol("[words]\nkeyboard_lost = \"Click here.\"\n"));
    int returns = 0;
    sitting.panel.lacks_keyboard = [&, is_away = false, gone_in = -1](const ScriptedPanel& panel) mutable {
        if (panel.phase() == SessionPhase::task_screen && panel.trial > gone_in) {
            gone_in = panel.trial;
            is_away = true;
        }
        if (is_away && panel.phase() == SessionPhase::pause && panel.looks >= 10) {
            is_away = false;
            ++returns;
        }
        return is_away;
    };
    sitting.panel.tell = [](ScriptedPanel& panel) -> std::optional<ResponsePress> {
        return panel.phase() == SessionPhase::task_screen && panel.looks < 3
                   ? std::optional(ResponsePress{Pressed::up, {}})
                   : std::nullopt;
    };
    CHECK(sitting.run().completed_trials == 2);
    CHECK(returns == 2);
    CHECK(std::ranges::count(sitting.presenter.texts, "Click here.") == 2);
    CHECK(sitting.panel.times_in(SessionPhase::pause) == 2);
    CHECK(sitting.panel.times_in(SessionPhase::task_screen) == 4);
    // The question is shown again, and the trial is what it was.
    CHECK(std::ranges::count(sitting.presenter.texts, "Look.") == 4);
    CHECK(sitting.log.started == std::vector<int>{0, 1});
}
