#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/checks/protocol_checks.h"
#include "experiment/design/task_trials.h"
#include "experiment/protocol/all_stimuli.h"
#include "experiment/protocol/entry_ids.h"
#include "experiment/protocol/keys/protocol_keys.h"

namespace overt {

namespace {

/// Levels reckoned by repeated steps are the written ones but for rounding.
bool is_same_level(double one, double other) {
    return std::abs(one - other) <= 1e-6 * std::max(std::abs(one), std::abs(other));
}

/// One procedure with the levels of one task's factor.
class ProcedureCheck {
  public:
    ProcedureCheck(ProtocolExamination& examination, std::size_t procedure, std::vector<double> levels)
        : examination_(examination), index_(procedure), settings_(examination.protocol.procedures[procedure]),
          levels_(std::move(levels)) {}

    void run() {
        const bool is_logarithmic = track_level(settings_, 1.0) != 1.0 ||
                                    (settings_.kind == ProcedureKind::staircase &&
                                     (settings_.scale == StepScale::db || settings_.scale == StepScale::log));
        if (is_logarithmic && levels_.front() <= 0.0)
            return error("kind",
                         fmt::format("it takes logarithms of levels, and {} has none", levels_.front()),
                         "use levels above 0, or another kind or scale");
        if (settings_.trials < static_cast<int>(levels_.size()))
            error("trials", fmt::format("{} trials are fewer than the {} levels that it chooses from",
                                        settings_.trials, levels_.size()));
        switch (settings_.kind) {
        case ProcedureKind::constant:
            check_levels("levels", settings_.levels);
            break;
        case ProcedureKind::staircase:
            check_staircase();
            break;
        case ProcedureKind::quest:
            if (settings_.p_threshold <=
                settings_.delta * settings_.guess_rate + (1.0 - settings_.delta) * settings_.guess_rate)
                error("p_threshold", "the share at threshold must be above the guess rate");
            break;
        case ProcedureKind::quest_plus:
            if (settings_.slopes.empty())
                error("slopes", "quest-plus needs slopes to choose between", "write slopes = [0.5, 1, 2, 4]");
            if (std::ranges::any_of(settings_.slopes, [](double slope) { return !(slope > 0.0); }))
                error("slopes", "slopes must be above 0");
            break;
        }
    }

  private:
    void error(std::string_view key, std::string message, std::string hint = {}) {
        examination_.error(
            {fmt::format("procedure[{}].{}", index_, key), fmt::format("procedure[{}].id", index_)},
            fmt::format("procedure \"{}\": {}", settings_.id, message), std::move(hint));
    }
    bool is_level(double level) const {
        return std::ranges::any_of(levels_, [&](double one) { return is_same_level(one, level); });
    }
    void check_levels(std::string_view key, const std::vector<double>& wanted) {
        for (const double level : wanted)
            if (!is_level(level))
                error(key, fmt::format("there is no stimulus of level {:.6g}", level),
                      fmt::format("the levels are {}", fmt::join(levels_, ", ")));
    }
    void check_staircase() {
        if (settings_.steps.empty() ||
            std::ranges::any_of(settings_.steps, [](double step) { return !(step > 0.0); }) ||
            std::ranges::any_of(settings_.steps_down, [](double step) { return !(step > 0.0); }))
            return error("steps", "steps must be above 0");
        if (settings_.start)
            check_levels("start", {*settings_.start});
        if (settings_.scale == StepScale::places) {
            for (const std::vector<double>* steps : {&settings_.steps, &settings_.steps_down})
                for (const double step : *steps)
                    if (step != std::round(step))
                        error("steps", fmt::format("{} is no whole number of places", step));
            return;
        }
        if (settings_.start && !is_level(*settings_.start))
            return; // which is said
        if (const std::optional<double> missing = unreachable())
            error("steps",
                  fmt::format("its steps can lead to the level {:.6g}, of which there is no stimulus",
                              *missing),
                  fmt::format("the levels are {}; scale = \"places\" goes from one to the next",
                              fmt::join(levels_, ", ")));
    }
    /// A level that steps lead to and that is none of the series, going on from each that is.
    std::optional<double> unreachable() const {
        const double lowest = settings_.lowest.value_or(levels_.front());
        const double highest = settings_.highest.value_or(levels_.back());
        std::vector<double> open{settings_.start.value_or(levels_.back())};
        std::set<std::size_t> known;
        while (!open.empty()) {
            const double level = open.back();
            open.pop_back();
            const auto here =
                std::ranges::find_if(levels_, [&](double one) { return is_same_level(one, level); });
            if (here == levels_.end())
                return level;
            if (!known.insert(static_cast<std::size_t>(here - levels_.begin())).second)
                continue;
            const auto from = [&](double step, double sign) {
                const double to = settings_.scale == StepScale::linear ? level + sign * step
                                  : settings_.scale == StepScale::db
                                      ? level * std::pow(10.0, sign * step / 20.0)
                                      : level * std::pow(10.0, sign * step);
                open.push_back(std::clamp(to, lowest, highest));
            };
            for (const double step : settings_.steps)
                from(step, 1.0);
            for (const double step : settings_.steps_down.empty() ? settings_.steps : settings_.steps_down)
                from(step, -1.0);
        }
        return std::nullopt;
    }

    ProtocolExamination& examination_;
    std::size_t index_;
    const ProcedureSettings& settings_;
    std::vector<double> levels_;
};

/// That the task has the answer that a procedure reads, and the answer what it counts.
void check_answer(ProtocolExamination& examination, std::size_t procedure, const Task& task) {
    const ProcedureSettings& settings = examination.protocol.procedures[procedure];
    const auto error = [&](std::string_view key, const std::string& message, std::string hint) {
        examination.error(
            {fmt::format("procedure[{}].{}", procedure, key), fmt::format("procedure[{}].id", procedure)},
            fmt::format("procedure \"{}\": {}", settings.id, message), std::move(hint));
    };
    if (task.answers.empty())
        return error("answer", fmt::format("the task \"{}\" has no answer to go by", task.id),
                     "give it a [[task.answer]]");
    const std::vector<std::string_view> ids = ids_of<std::string_view>(task.answers);
    const auto read = settings.answer.empty()
                          ? task.answers.begin()
                          : std::ranges::find(task.answers, settings.answer, &TaskAnswer::id);
    if (read == task.answers.end())
        return error("answer", fmt::format("the task \"{}\" has no answer \"{}\"", task.id, settings.answer),
                     suggest_name(settings.answer, ids));
    const bool has_standard = !task.trials.standard.empty();
    const auto has_choice = [&](const std::string& choice) {
        return std::ranges::find(read->choices, choice) != read->choices.end();
    };
    if (settings.yes == "test" || (settings.yes.empty() && has_standard)) {
        for (const std::string& slot : task.slots)
            if (has_standard && !has_choice(slot))
                return error(
                    "yes",
                    fmt::format("\"yes\" is the slot of the level that is chosen, and \"{}\" is no choice of "
                                "the answer \"{}\"",
                                slot, read->id),
                    "give the answer the slots as its choices, or write yes = \"correct\" or a choice");
        return;
    }
    if (settings.yes.empty() || settings.yes == "correct")
        return; // what is correct, the trial or the answer says
    if (read->is_choice() && !has_choice(settings.yes))
        error("yes", fmt::format("\"{}\" is no choice of the answer \"{}\"", settings.yes, read->id),
              fmt::format("its choices are {}", fmt::join(read->choices, ", ")));
}

/// The procedures that a task names, and the factor that they choose levels of.
void check_task_procedures(ProtocolExamination& examination, std::size_t task, std::set<std::string>& used) {
    const Protocol& protocol = examination.protocol;
    const TrialsSettings& trials = protocol.tasks[task].trials;
    const std::string key = fmt::format("task[{}].trials.procedure", task);
    const std::vector<std::string_view> known = ids_of<std::string_view>(protocol.procedures);
    for (const std::string& id : trials.procedures)
        if (std::ranges::find(known, id) == known.end())
            examination.error({key, fmt::format("task[{}].trials", task)},
                              fmt::format("there is no procedure \"{}\"", id), suggest_name(id, known));
    if (trials.procedures.empty())
        return;
    const Factors factors = factors_of(protocol);
    const RuleTask by = rule_task(protocol, static_cast<int>(task), all_stimuli(protocol));
    if (by.request.of.size() != 1)
        return; // which the rule says
    const Factor& factor = factors.at(by.request.of.front().name);
    std::vector<double> levels;
    for (const FactorLevel& level : factor.levels) {
        if (level.number)
            levels.push_back(*level.number);
        else if (level.name != no_level)
            return examination.error(
                {fmt::format("task[{}].trials.of", task), fmt::format("task[{}].trials", task)},
                fmt::format("the levels of \"{}\" are no numbers, so that no procedure can move along them",
                            factor.name),
                "name a series or a column with numbers");
    }
    std::ranges::sort(levels);
    for (std::size_t i = 0; i < protocol.procedures.size() && levels.size() > 1; ++i) {
        const std::string& id = protocol.procedures[i].id;
        if (std::ranges::find(trials.procedures, id) == trials.procedures.end())
            continue;
        used.insert(id);
        ProcedureCheck(examination, i, levels).run();
        check_answer(examination, i, protocol.tasks[task]);
    }
}

} // namespace

void check_procedures(ProtocolExamination& examination) {
    const std::vector<ProcedureSettings>& procedures = examination.protocol.procedures;
    std::set<std::string> used, seen;
    for (std::size_t i = 0; i < procedures.size(); ++i)
        if (!seen.insert(procedures[i].id).second)
            examination.error({fmt::format("procedure[{}].id", i)},
                              fmt::format("there are two procedures \"{}\"", procedures[i].id));
    for (std::size_t task = 0; task < examination.protocol.tasks.size(); ++task)
        check_task_procedures(examination, task, used);
    for (std::size_t i = 0; i < procedures.size(); ++i)
        if (!used.contains(procedures[i].id))
            examination.warning({fmt::format("procedure[{}].id", i)},
                                fmt::format("no task uses the procedure \"{}\"", procedures[i].id));
}

} // namespace overt
