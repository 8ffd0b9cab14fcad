#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/base/counted.h"
#include "experiment/checks/protocol_checks.h"
#include "experiment/design/block_plan.h"
#include "experiment/design/drawn_lists.h"
#include "experiment/design/task_trials.h"
#include "experiment/protocol/entry_ids.h"
#include "experiment/protocol/keys/protocol_keys.h"

namespace overt {

namespace {

/// The trials of one task, as its keys ask for them.
class TaskTrialsCheck {
  public:
    TaskTrialsCheck(ProtocolExamination& examination, int task)
        : examination_(examination), protocol_(examination.protocol), task_(task),
          settings_(protocol_.tasks[static_cast<std::size_t>(task)]) {}

    void run() {
        if (settings_.stimuli != TaskCoverage::every_stimulus && settings_.trials.has_own_trials())
            error({"stimuli", "trials"}, "\"trials\" says already which stimuli the task is asked for",
                  "leave out \"stimuli\"");
        const CatchSettings& checks = settings_.catch_trials;
        if (checks.share && checks.count)
            error({"catch.count"}, "\"share\" says already how many catch trials there are");
        if (checks.table >= 0)
            check_table(checks.table, "catch.trials");
        if (settings_.trials.table >= 0)
            return check_table(settings_.trials.table, "trials");
        if (!settings_.trials.rule)
            return;
        check_keys();
        // What is wrong in one block is most often so in the next.
        for (int block = 0; block < block_count(protocol_); ++block) {
            const BlockScope scope = scope_of(protocol_, block);
            const int before = errors_;
            if (std::ranges::find(scope.tasks, task_) != scope.tasks.end())
                check_block(block, stimuli_in(scope));
            if (errors_ > before)
                break;
        }
    }

  private:
    const TrialRuleRow& row() const { return row_of(*settings_.trials.rule); }
    std::string path(std::string_view key) const { return fmt::format("task[{}].{}", task_, key); }

    void error(const std::vector<std::string_view>& keys, std::string message, std::string hint = {}) {
        ++errors_;
        std::vector<std::string> paths;
        for (const std::string_view key : keys)
            paths.push_back(path(key));
        examination_.error(paths, std::move(message), std::move(hint));
    }
    void error_at_rule_key(std::string_view key, std::string message, std::string hint = {}) {
        const std::string inner = fmt::format("trials.{}", key);
        error({inner, "trials"}, std::move(message), std::move(hint));
    }

    /// Keys that say nothing to this rule.
    void check_keys() {
        std::vector<std::string_view> others;
        for (const TrialRuleRow& other : kinds_of<TrialRuleKind>)
            for (const std::string_view key : other.keys)
                if (!key.empty() && !row().has_key(key) && std::ranges::find(others, key) == others.end())
                    others.push_back(key);
        for (const std::string_view key : others) {
            if (!examination_.is_written(path(fmt::format("trials.{}", key))))
                continue;
            std::vector<std::string_view> users;
            for (const TrialRuleRow& other : kinds_of<TrialRuleKind>)
                if (other.has_key(key))
                    users.push_back(other.name);
            error_at_rule_key(key, fmt::format("\"{}\" says nothing to the rule \"{}\"", key, row().name),
                              fmt::format("it is for {}", fmt::join(users, ", ")));
        }
        for (const double size : settings_.trials.set_sizes)
            if (size != static_cast<int>(size))
                error_at_rule_key("set_sizes", fmt::format("{} is no whole number of stimuli", size));
    }

    /// The key among those of factors that has this name.
    std::string_view key_with(const std::string& name) const {
        const TrialsSettings& trials = settings_.trials;
        for (const auto& [key, names] :
             {std::pair("of", &trials.of), std::pair("same", &trials.same),
              std::pair("differs", &trials.differs), std::pair("any", &trials.any)})
            if (std::ranges::find(*names, name) != names->end())
                return key;
        return "of";
    }

    void check_block(int block, const std::vector<Stimulus>& stimuli) {
        const int before = errors_;
        const RuleTask by = rule_task(protocol_, task_, stimuli);
        const Factors factors = factors_of(protocol_);
        const std::vector<std::string_view> known = stimulus_factor_names(factors);
        for (const std::string& name : by.unknown)
            error_at_rule_key(key_with(name), fmt::format("there is no factor \"{}\"", name),
                              suggest_name(name, known));
        if (!by.unknown.empty())
            return;
        const std::string where =
            protocol_.blocks.empty() ? "" : fmt::format(" in block \"{}\"", block_at(protocol_, block).id);
        check_factors(by, where);
        if (errors_ > before)
            return;
        const auto rule = row().make(by.request);
        for (const RuleProblem& problem : rule->problems())
            error_at_rule_key(problem.key, problem.message, problem.hint);
        if (errors_ == before)
            check_count(*rule, where);
        if (errors_ == before && row().keeps_order)
            check_order(block);
    }

    void check_factors(const RuleTask& by, const std::string& where) {
        for (const std::vector<RuleFactor>* factors : {&by.request.of, &by.request.differs})
            for (const RuleFactor& factor : *factors) {
                std::vector<int> met = factor.of_stimulus;
                std::ranges::sort(met);
                met.erase(std::unique(met.begin(), met.end()), met.end());
                std::erase(met, -1);
                if (met.size() < 2 && row().name != "every")
                    error_at_rule_key(
                        key_with(factor.name),
                        fmt::format("the factor \"{}\" has {}{}, so that nothing can differ in it",
                                    factor.name, counted(met.size(), "level"), where),
                        "give its list more entries, or go by another factor");
            }
        if (row().name == "every" && !settings_.trials.of.empty())
            for (const std::string& list : by.unsaid)
                error_at_rule_key(
                    "of", fmt::format("nothing says which {} the trials show{}", list, where),
                    fmt::format("name \"{}\" in of, or choose one of them for the block", list));
        if (row().name != "every" && settings_.trials.of.empty() && by.request.of.size() != 1)
            error_at_rule_key(
                "of",
                by.request.of.empty()
                    ? fmt::format("there is nothing{} in which stimuli differ", where)
                    : fmt::format("nothing says in which factor the stimuli of a trial differ{}: {} differ",
                                  where, fmt::join(names_of_factors(by.request.of), " and ")),
                "write of = \"FACTOR\"");
    }

    static std::vector<std::string_view> names_of_factors(const std::vector<RuleFactor>& factors) {
        std::vector<std::string_view> names;
        for (const RuleFactor& factor : factors)
            names.push_back(factor.name);
        return names;
    }

    void check_count(const TrialRule& rule, const std::string& where) {
        const std::size_t count = rule.count();
        if (count == 0)
            error_at_rule_key("rule", fmt::format("the rule \"{}\" gives no trials{}", row().name, where),
                              "no stimuli are alike and differ as it asks for");
        else if (count > most_trials_of_observer)
            error_at_rule_key(
                "rule",
                fmt::format("the rule \"{}\" gives {}{} trials{}; {} is the most that a session can hold",
                            row().name, count >= Combinations::most ? "more than " : "", count, where,
                            most_trials_of_observer),
                row().has_key("draw") ? "draw some of them with draw = N" : "");
        else if (settings_.trials.draw && static_cast<std::size_t>(*settings_.trials.draw) > rule.available())
            error_at_rule_key("draw",
                              fmt::format("{} trials are drawn, and the rule \"{}\" gives {}{} to draw from",
                                          *settings_.trials.draw, row().name, rule.available(), where),
                              "without \"draw\" all of them come");
    }

    void check_order(int block) {
        if (block_at(protocol_, block).order == OrderMethod::sequential)
            return;
        error_at_rule_key(
            "rule", fmt::format("the trials of the rule \"{}\" come in its own order", row().name),
            protocol_.blocks.empty()
                ? "add a [[block]] with order = \"sequential\" for the task"
                : fmt::format("give block \"{}\" order = \"sequential\"", block_at(protocol_, block).id));
    }

    void check_table(int index, std::string_view key) {
        const TrialTable& table = protocol_.trial_tables[static_cast<std::size_t>(index)];
        for (std::size_t i = 0; i < table.factors.size(); ++i) {
            const bool is_one = std::ranges::all_of(table.rows, [&](const TrialTableRow& trial) {
                return level_in(trial, table.factors[i]) == level_in(table.rows.front(), table.factors[i]);
            });
            if (is_one && table.rows.size() > 1)
                examination_.warning({path(key)},
                                     fmt::format("the column \"{}\" of {} is the same in all rows",
                                                 table.factors[i], table.file));
        }
    }

    ProtocolExamination& examination_;
    const Protocol& protocol_;
    int task_;
    const Task& settings_;
    int errors_ = 0;
};

/// What a block draws of a list.
class DrawCheck {
  public:
    DrawCheck(ProtocolExamination& examination, int block)
        : examination_(examination), protocol_(examination.protocol), block_(block),
          draw_(block_at(protocol_, block).draw) {}

    void run() {
        if (!draw_.is_written())
            return;
        if (!list_called(draw_.of)) {
            std::vector<std::string_view> names;
            for (const StimulusList& list : stimulus_lists)
                names.push_back(list.name);
            return error("of", fmt::format("there is no list \"{}\"", draw_.of),
                         suggest_name(draw_.of, names));
        }
        if (draw_.from.empty())
            check_plain();
        else
            check_from();
    }

  private:
    std::string path(std::string_view key) const {
        return key.empty() ? fmt::format("block[{}].draw", block_)
                           : fmt::format("block[{}].draw.{}", block_, key);
    }
    void error(std::string_view key, std::string message, std::string hint = {}) {
        examination_.error(std::vector{path(key), path("")}, std::move(message), std::move(hint));
    }
    int listed(int block) const {
        return static_cast<int>(scope_of(protocol_, block).lists[*list_called(draw_.of)].size());
    }

    void check_plain() {
        for (const auto& [key, number] :
             {std::pair("old", draw_.old_entries), std::pair("new", draw_.new_entries)})
            if (number)
                error(key, fmt::format("\"{}\" says nothing without \"from\"", key),
                      "from = \"BLOCK\" says which block has shown the old ones");
        if (!draw_.count)
            error("", "nothing says how many are drawn", "write count = N");
        else
            check_enough("count", *draw_.count, listed(block_), "are listed");
    }

    void check_enough(std::string_view key, int wanted, int there, std::string_view state) {
        if (wanted > there)
            error(key, fmt::format("{} {}s are drawn, of {} that {}", wanted, draw_.of, there, state),
                  "draw fewer, or list more");
    }

    void check_from() {
        if (draw_.count)
            error("count", "with \"from\" it is \"old\" and \"new\" that say how many");
        const int before = block_called(protocol_, draw_.from);
        if (before < 0) {
            const auto ids = ids_of<std::string_view>(protocol_.blocks);
            return error("from", fmt::format("there is no block \"{}\"", draw_.from),
                         suggest_name(draw_.from, ids));
        }
        const DrawSettings& other = block_at(protocol_, before).draw;
        if (before >= block_)
            return error("from", fmt::format("block \"{}\" does not come before this one", draw_.from));
        if (protocol_.schedule.block_order != LevelOrder::fixed)
            return error("from",
                         fmt::format("block \"{}\" may come after this one, since the order of blocks is {}",
                                     draw_.from, name_of(protocol_.schedule.block_order)),
                         "leave schedule.block_order fixed");
        if (other.of != draw_.of)
            return error("from", other.is_written() ? fmt::format("block \"{}\" draws of {}, not of {}",
                                                                  draw_.from, other.of, draw_.of)
                                                    : fmt::format("block \"{}\" draws nothing", draw_.from));
        const int drawn = other.count.value_or(listed(before));
        if (drawn > listed(before))
            return; // which is said there
        if (draw_.old_entries)
            check_enough("old", *draw_.old_entries, std::min(drawn, listed(block_)), "are old");
        if (draw_.new_entries)
            check_enough("new", *draw_.new_entries, std::max(0, listed(block_) - drawn), "are new");
    }

    ProtocolExamination& examination_;
    const Protocol& protocol_;
    int block_;
    const DrawSettings& draw_;
};

} // namespace

void check_trials(ProtocolExamination& examination) {
    for (int block = 0; block < block_count(examination.protocol); ++block)
        DrawCheck(examination, block).run();
    for (int task = 0; task < static_cast<int>(examination.protocol.tasks.size()); ++task)
        TaskTrialsCheck(examination, task).run();
}

} // namespace overt
