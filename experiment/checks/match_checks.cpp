#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include <fmt/format.h>

#include "experiment/answers/answer_kinds.h"
#include "experiment/base/counted.h"
#include "experiment/checks/protocol_checks.h"
#include "experiment/design/match_levels.h"
#include "experiment/design/schedule.h"
#include "experiment/stimulus/frame_memory.h"

namespace overt {

namespace {

std::string match_path(std::size_t task, std::size_t answer, std::string_view key) {
    return fmt::format("task[{}].answer[{}].{}", task, answer, key);
}

/// Of one answer.
class MatchChecks {
  public:
    MatchChecks(ProtocolExamination& examination, std::size_t task, std::size_t answer)
        : examination_(examination), task_(task), number_(answer),
          answer_(examination.protocol.tasks[task].answers[answer]) {}

    void run() {
        check_slot();
        check_columns();
        check_keys();
        check_start();
        check_shown();
    }

  private:
    const Protocol& protocol() const { return examination_.protocol; }
    void error(std::string_view key, std::string message, std::string hint = {}) {
        examination_.error({match_path(task_, number_, key), match_path(task_, number_, "kind")},
                           std::move(message), std::move(hint));
    }

    void check_slot() {
        std::vector<std::string_view> ids;
        for (const int slot : slots_of_task(protocol(), static_cast<int>(task_)))
            ids.push_back(protocol().slots[static_cast<std::size_t>(slot)].id);
        if (answer_.slot.empty())
            error("slot",
                  fmt::format("\"{}\" does not say in which of the {} slots something is set", answer_.id,
                              ids.size()),
                  "write slot = with the id of one of them");
        else if (std::ranges::find(ids, answer_.slot) == ids.end())
            error("slot", fmt::format("the task has no slot \"{}\"", answer_.slot),
                  suggest_name(answer_.slot, ids));
        const std::vector<TaskAnswer>& all = protocol().tasks[task_].answers;
        for (std::size_t i = 0; i < number_; ++i)
            if (is_match(all[i]) && all[i].slot == answer_.slot)
                error("slot", fmt::format("\"{}\" sets what is in \"{}\" already", all[i].id, answer_.slot),
                      "one match can have two columns: along = [\"…\", \"…\"]");
    }

    void check_columns() {
        if (answer_.along.empty() || answer_.along.size() > 2)
            error("along",
                  answer_.along.empty() ? "a match needs a column along which it is set"
                                        : "a match is set along one column or two",
                  "write along = \"roughness\", the column of a series of materials or lights");
        else if (answer_.along.size() == 2 && answer_.along[0] == answer_.along[1])
            error("along", fmt::format("\"{}\" is there twice", answer_.along[0]));
    }

    void check_keys() {
        const std::size_t needed = 2 * std::max<std::size_t>(answer_.along.size(), 1);
        const std::string for_each =
            fmt::format("a match along {} has {} keys: for each column one to less and "
                        "one to more",
                        counted(static_cast<int>(needed / 2), "column"), needed);
        if (!answer_.keys.empty() && answer_.keys.size() != needed)
            error("keys", for_each);
        if (!answer_.coarse_keys.empty() && answer_.coarse_keys.size() != needed)
            error("coarse_keys", for_each);
        if (answer_.along.size() == 2 && answer_.with == AnsweredWith::mouse)
            error("with", "the wheel goes along the first column only",
                  "write with = \"keys\" or \"keys-and-mouse\"");
    }

    void check_start() {
        if (answer_.start.from == MatchStart::From::values &&
            answer_.start.values.size() != answer_.along.size())
            error("start",
                  fmt::format("start has {}, and there are {}",
                              counted(static_cast<int>(answer_.start.values.size()), "number"),
                              counted(static_cast<int>(answer_.along.size()), "column")),
                  "write a level for each column");
    }

    /// Entries that its slot has, whatever the trial says.
    void check_shown() {
        for (const NamedWord& said : answer_.shows) {
            const auto list =
                std::ranges::find(stimulus_lists, std::string_view(said.name), &StimulusList::name);
            if (list == stimulus_lists.end()) {
                std::vector<std::string_view> names;
                for (const StimulusList& one : stimulus_lists)
                    names.push_back(one.name);
                error("shows", fmt::format("there is no list \"{}\"", said.name),
                      suggest_name(said.name, names));
                continue;
            }
            const std::vector<std::string_view> ids =
                ids_in_list(protocol(), static_cast<std::size_t>(list - stimulus_lists.begin()));
            if (std::ranges::find(ids, said.text) == ids.end())
                error("shows", fmt::format("there is no {} \"{}\"", list->name, said.text),
                      suggest_name(said.text, ids));
        }
    }

    ProtocolExamination& examination_;
    std::size_t task_, number_;
    const TaskAnswer& answer_;
};

/// Observers whose trials are looked at: rotations have gone round by then.
constexpr int most_observers_looked_at = 12;

/// What all that stands ready for a trial takes, in MB.
double loaded_mb(const Protocol& protocol, const Trial& trial) {
    std::set<Stimulus> stimuli;
    for (const PlacedStimulus& loaded : loaded_for(protocol, trial))
        stimuli.insert(loaded.stimulus);
    double pages = 0.0;
    for (const Stimulus& stimulus : stimuli)
        pages += pages_of(protocol, stimulus);
    return 1e-6 * pages * page_bytes(protocol);
}

/// Of one answer where this stimulus stands. Whether it is sound.
bool check_levels_of_match(ProtocolExamination& examination, std::size_t task, std::size_t number,
                           const Stimulus& stimulus) {
    const TaskAnswer& answer = examination.protocol.tasks[task].answers[number];
    MatchProblem problem;
    const MatchLevels levels = match_levels_of(examination.protocol, answer, stimulus, problem);
    const auto path = [&](std::string_view key) { return match_path(task, number, key); };
    if (!problem.message.empty()) {
        examination.error({path("along"), path("kind")}, std::move(problem.message), std::move(problem.hint));
        return false;
    }
    bool is_sound = true;
    for (std::size_t i = 0; i < answer.start.values.size(); ++i)
        if (!level_at(levels.axes[i].values, answer.start.values[i])) {
            examination.error(
                {path("start")},
                fmt::format("no level of \"{}\" is {:g}", levels.axes[i].along, answer.start.values[i]),
                fmt::format("levels are {:g}", fmt::join(levels.axes[i].values, ", ")));
            is_sound = false;
        }
    return is_sound;
}

} // namespace

void check_matches(ProtocolExamination& examination) {
    for (std::size_t task = 0; task < examination.protocol.tasks.size(); ++task)
        for (std::size_t i = 0; i < examination.protocol.tasks[task].answers.size(); ++i)
            if (is_match(examination.protocol.tasks[task].answers[i]))
                MatchChecks(examination, task, i).run();
}

void check_match_levels(ProtocolExamination& examination) {
    const Protocol& protocol = examination.protocol;
    const bool has_any = std::ranges::any_of(
        protocol.tasks, [](const Task& task) { return std::ranges::any_of(task.answers, is_match); });
    if (!has_any)
        return;
    std::set<std::tuple<std::size_t, std::size_t, Stimulus>> known;
    std::set<std::size_t> told; ///< tasks
    const int observers = std::clamp(protocol.schedule.observers, 1, most_observers_looked_at);
    for (int observer = 1; observer <= observers; ++observer) {
        for (const Trial& trial : trials_of(protocol, observer)) {
            const auto task = static_cast<std::size_t>(trial.task);
            const std::vector<TaskAnswer>& answers = protocol.tasks[task].answers;
            for (std::size_t i = 0; i < answers.size(); ++i) {
                const std::vector<int> slots = slots_named(protocol, {answers[i].slot});
                for (const PlacedStimulus& shown : trial.all_shown())
                    if (is_match(answers[i]) && !slots.empty() && shown.slot == slots.front() &&
                        known.emplace(task, i, shown.stimulus).second && !told.contains(task) &&
                        !check_levels_of_match(examination, task, i, shown.stimulus))
                        told.insert(task);
            }
            const double needed_mb =
                std::ranges::any_of(answers, is_match) ? loaded_mb(protocol, trial) : 0.0;
            if (needed_mb > protocol.display.frame_store_mb && told.insert(task).second)
                examination.error(
                    {match_path(
                         task,
                         static_cast<std::size_t>(std::ranges::find_if(answers, is_match) - answers.begin()),
                         "along"),
                     "display.frame_store_mb", fmt::format("task[{}].id", task)},
                    fmt::format("what can be set in a trial of task {} takes {:.4g} MB of the frame store, "
                                "which may take {}",
                                protocol.tasks[task].id, needed_mb, protocol.display.frame_store_mb),
                    fmt::format("write frame_store_mb = {:.0f}, if the graphics card has as much, or take "
                                "fewer levels or poses",
                                std::ceil(needed_mb)));
        }
    }
}

} // namespace overt
