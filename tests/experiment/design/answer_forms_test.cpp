/// What a trial asks: what keys mean goes round evenly, items come in drawn orders, and the correct answer is
/// the trial's; a block ends by its criterion, also after a resumption.
#include "experiment/design/answer_forms.h"

#include <map>
#include <set>

#include <catch2/catch.hpp>

#include "experiment/answers/answer_kinds.h"
#include "experiment/design/block_feedback.h"
#include "experiment/design/trial_plan.h"
#include "experiment/design/trial_queue.h"
#include "tests/experiment/protocol/protocol_fixtures.h"

using namespace overt;
using namespace overt::test;

namespace {

Protocol asking_protocol(const std::string& more = {}) {
    const ReadText read(minimal_protocol, R"([[task.answer]]
id = "which"
kind = "choice"
choices = ["old", "new", "unsure"]
keys = ["f", "g", "h"]
[[task.answer]]
id = "gloss"
kind = "scale"
steps = 5
of = ["a", "b", "c"]
order = "drawn"
)" + more);
    REQUIRE(read.lines() == std::vector<std::string>{});
    return *read.protocol;
}

GivenAnswer judged(bool is_correct, double time_s = 0.5) {
    GivenAnswer given;
    given.is_missed = false;
    given.correct = "old";
    given.value = is_correct ? "old" : "new";
    given.is_correct = is_correct;
    given.window_onset = SessionTime();
    given.answered_at = SessionTime() + from_seconds(time_s);
    return given;
}

} // namespace

TEST_CASE("mappings go round over observers, or come equally often over trials", "[unit]") {
    Protocol protocol = asking_protocol();
    protocol.tasks[0].answers[0].mapping = AnswerMapping::observer;
    const Trial trial;
    for (int observer = 1; observer <= 6; ++observer)
        CHECK(answer_forms({protocol, trial, 7, observer}, {0}, 0).front().mapping == (observer - 1) % 3);
    protocol.tasks[0].answers[0].mapping = AnswerMapping::crossed;
    std::map<int, int> count;
    for (int rank = 0; rank < 30; ++rank)
        ++count[answer_forms({protocol, trial, 7, 1, rank}, {0}, 0).front().mapping];
    CHECK(count == std::map<int, int>{{0, 10}, {1, 10}, {2, 10}});
}

TEST_CASE("items of a scale come in an order that each trial has of its own, and keeps", "[unit]") {
    const Protocol protocol = asking_protocol();
    std::set<std::string> orders;
    for (int index = 0; index < 40; ++index) {
        Trial trial;
        trial.index = index;
        std::string order;
        for (const AnswerForm& form : answer_forms({protocol, trial, 7}, {1}, 2)) {
            CHECK(form.place == 2 + static_cast<int>(order.size()));
            order += form.item;
        }
        std::string again;
        for (const AnswerForm& form : answer_forms({protocol, trial, 7}, {1}, 2))
            again += form.item;
        CHECK(order == again);
        orders.insert(order);
    }
    CHECK(orders.size() == 6);
}

TEST_CASE("the trial's correct answer is that of a choice that has it, and of no other answer", "[unit]") {
    const Protocol protocol = asking_protocol();
    Trial trial;
    trial.correct = "new";
    const std::vector<TaskAnswer>& answers = protocol.tasks[0].answers;
    CHECK(correct_value(protocol, answers[0], trial) == "new");
    CHECK(correct_value(protocol, answers[1], trial).empty());
    trial.correct = "left";
    CHECK(correct_value(protocol, answers[0], trial).empty());
    TaskAnswer by_column = answers[0];
    by_column.correct = "column:object";
    CHECK(correct_value(protocol, by_column, trial) == "a");
    trial.levels = {{"object", "old"}};
    CHECK(correct_value(protocol, by_column, trial) == "old");
    by_column.correct = "none";
    CHECK(correct_value(protocol, by_column, trial).empty());
}

TEST_CASE("a task with answers and no steps asks each on a screen after the stimulus", "[unit]") {
    const Protocol protocol = asking_protocol();
    const TrialPlan plan = plan_trial(protocol, 7, {}, false);
    REQUIRE(plan.steps.size() == 5);
    REQUIRE(plan.sheets.size() == 2);
    CHECK(plan.steps[3].sheet == 0);
    CHECK(plan.steps[4].id == "gloss");
    CHECK(plan.sheets[0].stimulus_step == 2);
    CHECK_FALSE(plan.sheets[0].waits_unseen);
}

TEST_CASE("a step that waits for an answer shares the sheet of the next that asks", "[unit]") {
    const ReadText read(minimal_protocol, R"([[task]]
id = "t"
question = "?"
steps = [ { fixation = 0.5 }, { show = "centre", for_s = 1, until = "answer" }, { blank = 0.1 },
          { answer = "a", limit_s = 1 }, { answer = "b" } ]
[[task.answer]]
id = "a"
kind = "key"
keys = ["f"]
[[task.answer]]
id = "b"
kind = "text"
)");
    REQUIRE(read.lines() == std::vector<std::string>{});
    Trial trial;
    trial.task = 1;
    const TrialPlan plan = plan_trial(*read.protocol, 7, trial, false);
    REQUIRE(plan.sheets.size() == 2);
    CHECK(plan.steps[1].sheet == 0);
    CHECK(plan.steps[2].sheet == -1);
    CHECK(plan.steps[3].sheet == 0);
    CHECK(plan.sheets[0].waits_unseen);
    CHECK(plan.sheets[0].stimulus_step == 1);
    CHECK(plan.sheets[1].stimulus_step == 1);
    CHECK_FALSE(plan.sheets[1].waits_unseen);
}

TEST_CASE("a block is over when its criterion is met, and an interrupted one goes on alike", "[unit]") {
    const Protocol protocol = asking_protocol(R"([[block]]
id = "practice"
repetitions = 12
criterion = { correct = 3, of_last = 4, at_least = 5 }
feedback = "{percent_correct}"
[[block]]
id = "test"
)");
    Schedule schedule;
    for (int i = 0; i < 13; ++i) {
        Trial trial;
        trial.index = i;
        trial.block = i < 12 ? 0 : 1;
        schedule.trials.push_back(trial);
    }
    const std::vector<bool> answers{true, true, true, false, true, false, false};
    TrialQueue queue(protocol, schedule);
    SessionHistory history;
    std::vector<int> left_out;
    for (const bool is_correct : answers) {
        const auto step = queue.next();
        REQUIRE(step);
        if (step->kind != SessionStep::Kind::trial)
            break;
        AttemptResult result;
        result.given = {judged(is_correct)};
        queue.tell(result);
        history.steps.push_back(
            {RecordedStep::Kind::trial, step->trial.index, AttemptFate::counted, {}, result.given});
        left_out = queue.take_left_out();
        if (!left_out.empty())
            break;
    }
    // Three of the last four after the fourth, but five come at least.
    CHECK(history.steps.size() == 5);
    CHECK(left_out == std::vector<int>{5, 6, 7, 8, 9, 10, 11});
    CHECK(queue.next()->kind == SessionStep::Kind::feedback);
    CHECK(queue.next()->trial.index == 12);

    TrialQueue resumed(protocol, schedule);
    resumed.go_through(history.steps);
    CHECK(resumed.next()->kind == SessionStep::Kind::feedback);
    CHECK(resumed.next()->trial.index == 12);
}

TEST_CASE("feedback on a block counts answers, those that are correct, and their median time", "[unit]") {
    GivenAnswer missed;
    missed.correct = "old";
    const AnsweredTrials trials{{judged(true, 0.4)}, {judged(false, 0.8)}, {missed}, {judged(true, 0.6)}};
    CHECK(in_numbers("{percent_correct} % of {trials}, {missed} missed, {median_s} s", trials) ==
          "67 % of 4, 1 missed, 0.60 s");
    CHECK(in_numbers("{percent_correct}", {}) == "–");
    // Of an even number, the mean of the two in the middle.
    CHECK(in_numbers("{median_s}",
                     {{judged(true, 0.9)}, {judged(true, 0.3)}, {judged(true, 0.4)}, {judged(false, 0.7)}}) ==
          "0.55");
}
