/// A screen that is not what it was any more, and times that nothing proves.
#include "experiment/session/missed_in_words.h"
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
