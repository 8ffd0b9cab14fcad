#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/answers/answer_kinds.h"
#include "experiment/base/text_number.h"
#include "experiment/checks/observer_keys.h"
#include "experiment/checks/protocol_checks.h"
#include "experiment/design/answer_forms.h"
#include "experiment/design/match_levels.h"
#include "experiment/design/trial_plan.h"

namespace overt {

namespace {

/// Of one answer of a task.
class AnswerChecks {
  public:
    AnswerChecks(ProtocolExamination& examination, std::size_t task, std::size_t answer)
        : examination_(examination), task_(examination.protocol.tasks[task]), answer_(task_.answers[answer]),
          path_(fmt::format("task[{}].answer[{}]", task, answer)) {}

    void run() {
        if (examination_.faulty.contains(path_ + ".kind"))
            return;
        check_foreign_keys();
        check_choices();
        check_keys();
        check_scale();
        check_numbers();
        check_pointing();
        check_correct();
        check_odd_one_out();
        check_window();
        check_truth();
    }

  private:
    std::string at(std::string_view key) const { return fmt::format("{}.{}", path_, key); }
    void error(const std::vector<std::string_view>& keys, std::string message, std::string hint = {}) {
        std::vector<std::string> paths;
        for (const std::string_view key : keys)
            paths.push_back(at(key));
        paths.push_back(at("kind"));
        examination_.error(paths, std::move(message), std::move(hint));
    }
    const AnswerKindRow& kind() const { return row_of(answer_.kind); }
    bool has(std::string_view key) const { return kind().has_key(key); }
    bool by_keys() const { return answer_.with != AnsweredWith::mouse; }

    void check_foreign_keys() {
        for (const AnswerKindRow& row : kinds_of<AnswerKind>)
            for (const std::string_view key : row.keys)
                if (!key.empty() && !has(key) && examination_.is_written(at(key)) &&
                    told_.insert(std::string(key)).second)
                    error({key}, fmt::format("an answer of kind \"{}\" has no \"{}\"", kind().name, key));
    }

    void check_choices() {
        const std::size_t count = answer_.choices.size();
        if (has("labels") && has("choices") && count < 2)
            error({"choices"}, "a choice needs two \"choices\" at least",
                  "write choices = [\"left\", \"right\"]");
        for (std::size_t i = 0; i < count; ++i)
            if (std::ranges::find(
                    answer_.choices.begin(), answer_.choices.begin() + static_cast<std::ptrdiff_t>(i),
                    answer_.choices[i]) != answer_.choices.begin() + static_cast<std::ptrdiff_t>(i))
                error({"choices"}, fmt::format("the choice \"{}\" is there twice", answer_.choices[i]));
        if (has("choices") && by_keys() && answer_.keys.empty())
            error({"keys", "choices"},
                  has("labels") ? "the choices have no keys, and cannot be given"
                                : "no keys are named that answer",
                  count > 0 ? "write keys, one for each choice, or with = \"mouse\""
                            : "write keys = [\"f\", \"j\"]");
        else if (count > 0 && by_keys() && answer_.keys.size() != count)
            error({"keys"}, fmt::format("there are {} choices and {} keys", count, answer_.keys.size()),
                  "write one key for each, in the same order");
        if (has("choices") && !answer_.labels.empty() && answer_.labels.size() != count)
            error({"labels"},
                  fmt::format("there are {} choices and {} labels", count, answer_.labels.size()));
        if (answer_.mapping != AnswerMapping::fixed &&
            std::ranges::any_of(answer_.choices, [&](auto& choice) { return is_slot(choice); }))
            error({"mapping"},
                  "choices that are slots stand where their stimuli do: keys cannot go round over them",
                  "sides of stimuli are crossed or drawn by the rule of the trials: side = \"crossed\"");
    }
    bool is_slot(const std::string& id) const {
        return std::ranges::find(examination_.protocol.slots, id, &Slot::id) !=
               examination_.protocol.slots.end();
    }

    void check_keys() {
        std::vector<std::pair<std::string_view, std::string>> keys;
        for (const std::string& key : is_match(answer_) ? answer_.match_keys() : answer_.keys)
            keys.emplace_back("keys", key);
        for (const std::string& key : is_match(answer_) ? answer_.match_coarse_keys() : answer_.coarse_keys)
            keys.emplace_back("coarse_keys", key);
        if (answer_.accepts_by_key())
            keys.emplace_back("accept_key", answer_.accept_key);
        if (has("undo_key"))
            keys.emplace_back("undo_key", answer_.undo_key);
        for (std::size_t i = 0; i < keys.size(); ++i) {
            const auto& [path, key] = keys[i];
            const auto earlier = std::find_if(keys.begin(), keys.begin() + static_cast<std::ptrdiff_t>(i),
                                              [&](const auto& before) { return before.second == key; });
            if (earlier != keys.begin() + static_cast<std::ptrdiff_t>(i))
                error({path}, fmt::format("the key \"{}\" answers two things", key));
            check_key(path, key);
        }
    }

    void check_key(std::string_view path, const std::string& key) {
        if (KeyFault fault = fault_of_observer_key(examination_.protocol, key); !fault.message.empty())
            error({path}, std::move(fault.message), std::move(fault.hint));
    }

    void check_scale() {
        if (!has("steps"))
            return;
        if (answer_.steps) {
            const auto count = static_cast<std::size_t>(*answer_.steps);
            if (!answer_.labels.empty() && answer_.labels.size() != count)
                error({"labels"},
                      fmt::format("there are {} steps and {} labels", count, answer_.labels.size()));
            if (!answer_.keys.empty() && answer_.keys.size() != count)
                error({"keys"}, fmt::format("there are {} steps and {} keys", count, answer_.keys.size()));
            if (examination_.is_written(at("step")))
                error({"step"}, "a scale with \"steps\" goes from step to step", "leave out step, or steps");
            if (answer_.ticks > 0)
                error({"ticks"}, "ticks are for a line: a scale with steps has its steps");
        } else if (!answer_.labels.empty() || !answer_.keys.empty()) {
            error({"labels", "keys"}, "a line has neither labels nor keys of its own",
                  "write steps for a scale of steps, and ends for words at a line's ends");
        }
        if (!answer_.ends.empty() && answer_.ends.size() < 2)
            error({"ends"}, "a scale has two ends", "write ends = [\"not at all\", \"very\"]");
        if (!(answer_.low() < answer_.high()))
            error({"max", "min"},
                  fmt::format("the scale goes from {:g} to {:g}", answer_.low(), answer_.high()),
                  "min is the value of the low end, and smaller than max");
        if (answer_.order == ItemOrder::drawn && answer_.items.empty())
            error({"order"}, "there is one item only, and no order to draw", "name the items in `of`");
        if (!answer_.accepts_by_key() && !answer_.steps && by_keys())
            error({"accept"}, "on a line every move by a key would be an answer",
                  "leave out accept, or write with = \"mouse\"");
    }

    void check_pointing() {
        if (!has("by"))
            return;
        if (answer_.by != PointedBy::mouse && answer_.keys.empty())
            error({"by", "keys"}, fmt::format("nothing says with which key \"{}\" is given", answer_.id),
                  "write keys = [\"space\"]");
        if (answer_.by == PointedBy::mouse && !answer_.keys.empty())
            error({"keys"}, "a point that is clicked on needs no keys",
                  "write by = \"gaze\" for where gaze is when a key is pressed");
    }

    void check_numbers() {
        if (has("unit") && answer_.min && answer_.max && !(*answer_.min < *answer_.max))
            error({"max", "min"},
                  fmt::format("no number lies between {:g} and {:g}", *answer_.min, *answer_.max));
    }

    void check_correct() {
        const std::string& correct = answer_.correct;
        constexpr std::string_view of_column = "column:";
        if (correct.empty() || correct == "none")
            return;
        if (correct.starts_with(of_column)) {
            const std::string_view column = std::string_view(correct).substr(of_column.size());
            const Factors factors = factors_of(examination_.protocol);
            const std::vector<NamedWord> own = own_levels_of(examination_.protocol);
            if (!factors.find(column) && std::ranges::find(own, column, &NamedWord::name) == own.end())
                error({"correct"}, fmt::format("there is no column \"{}\"", column),
                      suggest_name(column, factors.names()));
            return;
        }
        const std::vector<std::string>& values = answer_.is_choice() ? answer_.choices : answer_.keys;
        if (has("choices") && std::ranges::find(values, correct) == values.end())
            error({"correct"}, fmt::format("no choice is \"{}\"", correct),
                  fmt::format("choices are {}; column:NAME stands for a column", fmt::join(values, ", ")));
        if ((has("steps") || has("unit")) && answer_.labels.empty() && !number_in<double>(correct))
            error({"correct"}, fmt::format("\"{}\" is no number", correct));
    }

    void check_window() {
        using From = AnswerOpening::From;
        const bool is_by_stimulus = answer_.opens.from == From::onset || answer_.opens.from == From::offset;
        const bool is_shown =
            task_.steps.empty() ||
            std::ranges::find(task_.steps, StepKind::show, &StepSettings::kind) != task_.steps.end();
        if (is_by_stimulus && !is_shown)
            error({"opens"}, "no step of the task shows a stimulus by which the window could open");
        if (answer_.counts == AnswerCounts::last && !answer_.accepts_by_key() && answer_.ends_step &&
            !answer_.limit_s)
            error({"counts"}, "the last of several presses is not known before the time is up",
                  "write limit_s, and ends_step = false");
        if (!answer_.ends_step && !answer_.limit_s && !has_limited_step())
            error({"ends_step"}, "nothing ends the step in which it is answered",
                  "write limit_s here, or at the step answer");
    }
    bool has_limited_step() const {
        return std::ranges::any_of(task_.steps, [&](const StepSettings& step) {
            return step.kind == StepKind::answer && step.duration &&
                   std::ranges::find(step.answers, answer_.id) != step.answers.end();
        });
    }

    void check_numeric_factor(const std::string& path, const std::string& name) {
        const std::vector<NamedWord> own = own_levels_of(examination_.protocol);
        if (std::ranges::any_of(own, [&](const NamedWord& level) {
                return level.name == name && number_in<double>(level.text).has_value();
            }))
            return;
        const Factors factors = factors_of(examination_.protocol);
        const Factor* const factor = factors.find(name);
        const auto is_number = [](const auto& level) { return level.number.has_value(); };
        if (!factor)
            examination_.error({path}, fmt::format("there is no factor \"{}\"", name),
                               suggest_name(name, factors.names()));
        else if (std::ranges::none_of(factor->levels, is_number))
            examination_.error({path}, fmt::format("the levels of \"{}\" are no numbers", name),
                               "a series makes numbers, and a column may have them");
    }

    void check_odd_one_out() {
        if (kind().name != odd_one_out_kind)
            return;
        const auto slots =
            std::ranges::count_if(answer_.choices, [&](const auto& choice) { return is_slot(choice); });
        if (slots < 3 || slots != static_cast<std::ptrdiff_t>(answer_.choices.size()))
            error({"choices"}, "one is odd among three slots or more",
                  "have three or more of the task's slots, and nothing else, as choices");
    }

    void check_truth() {
        const AnswerTruth& truth = answer_.truth;
        const std::string path = at("simulated");
        if (!truth.by.empty())
            check_numeric_factor(path + ".by", truth.by);
        if (!truth.time_by.empty())
            check_numeric_factor(path + ".time_by", truth.time_by);
        else if (truth.time_gain_s != 0.0)
            examination_.error({path + ".time_gain_s"}, "nothing says with which factor times grow",
                               "write time_by = \"set_size\"");
        if (truth.look_share &&
            (!answer_.is_choice() || std::ranges::any_of(answer_.choices, [&](const std::string& choice) {
                return std::ranges::find(task_.slots, choice) == task_.slots.end();
            })))
            examination_.error({path + ".look_share"}, "there is a slot to look at for choices among slots",
                               "have the task's slots as choices");
        if (!truth.look_area.empty() &&
            (!answer_.is_choice() || std::ranges::none_of(simulated_shares(task_), [&](const auto& share) {
                return share.first == truth.look_area && share.second > 0.0;
            })))
            examination_.error({path + ".look_area"},
                               fmt::format("the task does not say how often \"{}\" is looked at, or this is "
                                           "no choice",
                                           truth.look_area),
                               "write simulated_area_shares for the task");
        if (!truth.shear.empty() && (truth.shear.size() != 2 || !has("probe")))
            examination_.error({path + ".shear"},
                               "shear is two numbers, of a gauge: to the right and upwards");
        if (!truth.cuts.empty() &&
            (!answer_.steps || truth.cuts.size() + 1 != static_cast<std::size_t>(*answer_.steps) ||
             !std::ranges::is_sorted(truth.cuts)))
            examination_.error({path + ".cuts"}, "cuts lie between the steps of a scale, in rising order",
                               "write one fewer than steps");
    }

    ProtocolExamination& examination_;
    const Task& task_;
    const TaskAnswer& answer_;
    std::string path_;
    std::set<std::string> told_;
};

/// Ids of a task's answers, and which steps ask for them.
class AskingChecks {
  public:
    AskingChecks(ProtocolExamination& examination, std::size_t task)
        : examination_(examination), task_(examination.protocol.tasks[task]), number_(task) {}

    void run() {
        for (std::size_t i = 0; i < task_.answers.size(); ++i) {
            const std::string& id = task_.answers[i].id;
            const std::string path = fmt::format("task[{}].answer[{}].id", number_, i);
            const auto same = std::ranges::find(task_.answers, id, &TaskAnswer::id);
            if (!id.empty() && same != task_.answers.begin() + static_cast<std::ptrdiff_t>(i))
                examination_.error({path}, fmt::format("answer \"{}\" is there twice", id));
            if (id == "spoken")
                examination_.error({path}, "\"spoken\" stands for the answer of a task without any",
                                   "give it another id; kind = \"spoken\" makes it a spoken one");
            if (!id.empty() && !task_.steps.empty() && !is_asked(id))
                examination_.error({path}, fmt::format("no step asks for the answer \"{}\"", id),
                                   fmt::format("add the step {{ answer = \"{}\" }}", id));
        }
        for (const StepSettings& step : task_.steps)
            check_step(step);
        check_points();
    }

  private:
    void error(Place place, std::string message, std::string hint = {}) {
        examination_.diagnostics().error(examination_.protocol.file.string(), place, std::move(message),
                                         std::move(hint));
    }

    bool is_asked(const std::string& id) const {
        const bool is_named = std::ranges::any_of(task_.steps, [&](const StepSettings& step) {
            return std::ranges::find(step.answers, id) != step.answers.end();
        });
        // Steps that wait for answers without a screen of their own wait for all.
        const auto last_waits =
            std::ranges::find_if(task_.steps.rbegin(), task_.steps.rend(), [](const StepSettings& step) {
                return step.ends_by_answer || (step.kind == StepKind::answer && !step.answers.empty());
            });
        return is_named || (last_waits != task_.steps.rend() && last_waits->ends_by_answer);
    }

    void check_step(const StepSettings& step) {
        std::vector<std::string_view> ids;
        for (const TaskAnswer& answer : task_.answers)
            ids.push_back(answer.id);
        int spoken = 0;
        for (const std::string& id : step.answers) {
            const auto found = std::ranges::find(task_.answers, id, &TaskAnswer::id);
            if (found == task_.answers.end())
                error(step.answers_place, fmt::format("task {} has no answer \"{}\"", task_.id, id),
                      task_.answers.empty() ? "add a [[task.answer]] below the task, or write \"spoken\""
                                            : suggest_name(id, ids));
            else if (!row_of(found->kind).make)
                ++spoken;
        }
        if (spoken > 0 && step.answers.size() > 1)
            error(step.answers_place, "a spoken answer has a screen of its own", "give it a step of its own");
        if (!step.ends_by_answer)
            return;
        const bool has_any = std::ranges::any_of(
            task_.answers, [](const TaskAnswer& answer) { return row_of(answer.kind).make != nullptr; });
        if (!has_any)
            error(step.answers_place, fmt::format("task {} has no answer that could end this step", task_.id),
                  "add a [[task.answer]] below the task");
        for (const TaskAnswer& answer : answers_waited_for(step))
            if (!row_of(answer.kind).is_given_unseen &&
                !(answer.steps && !answer.accepts_by_key() && answer.items.empty()))
                error(step.answers_place,
                      fmt::format("\"{}\" is a {}, and cannot be given while it is not on the screen",
                                  answer.id, name_of(answer.kind)),
                      "ask for it in a step { answer = … }; keys, choices, and scales of steps with accept = "
                      "\"at-once\" can end a stimulus");
            else if (name_of(answer.kind) == "gauge" && answers_waited_for(step).size() > 1)
                error(
                    step.answers_place,
                    fmt::format("the gauge \"{}\" takes the mouse and the arrows, and cannot be set together "
                                "with other answers",
                                answer.id),
                    "give each a step of its own: { answer = [...] } behind the step that shows the "
                    "stimulus");
            else if (is_match(answer) && answers_waited_for(step).size() > 1 &&
                     std::ranges::any_of(answer.match_keys(), [](const std::string& key) {
                         return key == "up" || key == "down" || key == "tab";
                     }))
                error(step.answers_place,
                      fmt::format(
                          "up, down and tab go from one answer to the next, and \"{}\" is set with them",
                          answer.id),
                      "write other keys for it, or give the answers steps of their own");
            else if (answer.with == AnsweredWith::mouse && !answer.beside_up_deg && !is_match(answer) &&
                     !shows_choices(step, answer))
                error(step.answers_place,
                      fmt::format("\"{}\" is given with the mouse, and nothing to click on is on the screen",
                                  answer.id),
                      "write beside_up_deg, where it stands beside the stimulus");
    }

    /// The choices are slots that the step shows, and are clicked on themselves.
    bool shows_choices(const StepSettings& step, const TaskAnswer& answer) const {
        const Protocol& protocol = examination_.protocol;
        const std::vector<int> slots =
            step.slots.empty() ? slots_of_task(protocol, static_cast<int>(&task_ - protocol.tasks.data()))
                               : slots_named(protocol, step.slots);
        return step.kind == StepKind::show && answer.is_choice() &&
               std::ranges::all_of(answer.choices, [&](const std::string& choice) {
                   return std::ranges::any_of(slots, [&](int slot) {
                       return protocol.slots[static_cast<std::size_t>(slot)].id == choice;
                   });
               });
    }

    /// Of a gauge: the slot of its probe is lit.
    bool lights_place_of(const StepSettings& step, const TaskAnswer& answer) const {
        const ProbeSettings* const probe =
            row_of(answer.kind).has_key("probe") ? probe_of(task_, answer) : nullptr;
        if (!probe || probe->slot.empty() || step.slots.empty())
            return true;
        const Protocol& protocol = examination_.protocol;
        return std::ranges::any_of(slots_named(protocol, step.slots), [&](int slot) {
            return protocol.slots[static_cast<std::size_t>(slot)].id == probe->slot;
        });
    }

    /// What is pointed at has to be there.
    void check_points() {
        for (std::size_t i = 0; i < task_.answers.size(); ++i) {
            const TaskAnswer& answer = task_.answers[i];
            const bool is_gauge = row_of(answer.kind).has_key("probe");
            if (name_of(answer.kind) != "point" && !is_gauge && !is_match(answer))
                continue;
            if (is_gauge)
                check_probe(answer, fmt::format("task[{}].answer[{}]", number_, i));
            const bool is_there = std::ranges::any_of(task_.steps, [&](const StepSettings& step) {
                const std::vector<TaskAnswer> awaited = answers_waited_for(step);
                return step.kind == StepKind::show && step.ends_by_answer && lights_place_of(step, answer) &&
                       std::ranges::find(awaited, answer.id, &TaskAnswer::id) != awaited.end();
            });
            if (!is_there)
                examination_.error(
                    {fmt::format("task[{}].answer[{}].kind", number_, i)},
                    fmt::format("nothing is shown while \"{}\" is {}", answer.id,
                                is_gauge || is_match(answer) ? "set" : "pointed at"),
                    "have a step of the task that shows the stimulus wait for it: until = \"answer\"");
        }
    }

    void check_probe(const TaskAnswer& answer, const std::string& path) {
        std::vector<std::string_view> ids;
        for (const ProbeSettings& probe : task_.probes)
            ids.push_back(probe.id);
        if (task_.probes.empty())
            examination_.error({path + ".kind"},
                               fmt::format("the gauge \"{}\" has no place to stand at", answer.id),
                               "add a [[task.probe]] with the id of [[points]]");
        else if (answer.probe.empty() && task_.probes.size() > 1)
            examination_.error(
                {path + ".kind"},
                fmt::format("task {} has {} probes, and \"{}\" says at which it stands nowhere", task_.id,
                            task_.probes.size(), answer.id),
                fmt::format("write probe = \"{}\"", task_.probes.front().id));
        else if (!probe_of(task_, answer))
            examination_.error({path + ".probe"}, fmt::format("there is no probe \"{}\"", answer.probe),
                               suggest_name(answer.probe, ids));
    }

    /// Of the next step that asks, or all.
    std::vector<TaskAnswer> answers_waited_for(const StepSettings& step) const {
        std::vector<TaskAnswer> answers;
        const StepSettings* asks = nullptr;
        for (const StepSettings* next = &step; next != task_.steps.data() + task_.steps.size() && !asks;
             ++next)
            if (next->kind == StepKind::answer && !next->answers.empty())
                asks = next;
        for (const TaskAnswer& answer : task_.answers)
            if (row_of(answer.kind).make &&
                (!asks || std::ranges::find(asks->answers, answer.id) != asks->answers.end()))
                answers.push_back(answer);
        return answers;
    }

    ProtocolExamination& examination_;
    const Task& task_;
    std::size_t number_;
};

/// Blocks that end by what was answered.
void check_criteria(ProtocolExamination& examination) {
    const Protocol& protocol = examination.protocol;
    for (std::size_t i = 0; i < protocol.blocks.size(); ++i) {
        const BlockSettings& block = protocol.blocks[i];
        const std::string path = fmt::format("block[{}].criterion", i);
        if (!block.criterion.is_written())
            continue;
        if (block.criterion.of_last > 0 && block.criterion.of_last < block.criterion.correct)
            examination.error({path + ".of_last"},
                              fmt::format("of the last {} never {} are correct", block.criterion.of_last,
                                          block.criterion.correct));
        const bool is_answered = std::ranges::any_of(protocol.tasks, [&](const Task& task) {
            const bool is_asked =
                block.tasks.empty() || std::ranges::find(block.tasks, task.id) != block.tasks.end();
            return is_asked && !task.answers.empty();
        });
        if (!is_answered)
            examination.error(
                {path}, fmt::format("nothing that is correct or wrong is answered in block \"{}\"", block.id),
                "add a [[task.answer]] to a task of the block");
    }
}

} // namespace

void check_answers(ProtocolExamination& examination) {
    const std::vector<Task>& tasks = examination.protocol.tasks;
    for (std::size_t i = 0; i < tasks.size(); ++i) {
        for (std::size_t k = 0; k < tasks[i].answers.size(); ++k)
            AnswerChecks(examination, i, k).run();
        if (!examination.faulty.contains(fmt::format("task[{}].steps", i)))
            AskingChecks(examination, i).run();
    }
    check_criteria(examination);
}

} // namespace overt
