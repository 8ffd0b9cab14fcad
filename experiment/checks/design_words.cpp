#include "experiment/checks/design_words.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "experiment/base/counted.h"
#include "experiment/checks/design_report.h"
#include "experiment/design/block_plan.h"
#include "experiment/design/task_trials.h"

namespace overt {

namespace {

using Texts = std::vector<std::string>;

/// "roughness (5 levels) and light (2 levels)".
std::string with_levels(const std::vector<RuleFactor>& factors) {
    Texts words;
    for (const RuleFactor& factor : factors)
        words.push_back(fmt::format("{} ({})", factor.name, counted(factor.levels.size(), "level")));
    return fmt::format("{}", fmt::join(words, " and "));
}

std::string names_or(const Texts& names, std::string_view otherwise) {
    return names.empty() ? std::string(otherwise) : fmt::format("{}", fmt::join(names, ", "));
}

Texts ids_of_slots(const Protocol& protocol, int task) {
    Texts ids;
    for (const int slot : slots_of_task(protocol, task))
        ids.push_back(protocol.slots[static_cast<std::size_t>(slot)].id);
    return ids;
}

/// What a task without a rule or a table shows.
Texts words_of_coverage(const Protocol& protocol, int block, int task, const BlockScope& scope) {
    const std::vector<Stimulus> stimuli = stimuli_in(scope);
    const Factors factors = factors_of(protocol);
    std::vector<RuleFactor> lists;
    for (const StimulusList& list : stimulus_lists) {
        RuleFactor factor = *stimulus_factor(factors, stimuli, list.name);
        std::vector<int> met = factor.of_stimulus;
        std::ranges::sort(met);
        const auto count = std::unique(met.begin(), met.end()) - met.begin();
        factor.levels.resize(static_cast<std::size_t>(count));
        if (count > 1)
            lists.push_back(std::move(factor));
    }
    Texts sentences{rotates(protocol, block, task)
                        ? fmt::format("each object once, its {} going round over the observers",
                                      protocol.schedule.rotated_list)
                    : lists.empty() ? std::string("the only stimulus")
                                    : "every stimulus: " + with_levels(lists)};
    const Texts slots = ids_of_slots(protocol, task);
    if (slots.size() > 1)
        sentences.push_back(fmt::format("the same in {}", names_or(slots, "")));
    return sentences;
}

Texts words_of_rule(const Protocol& protocol, int task, const BlockScope& scope) {
    const TrialsSettings& trials = protocol.tasks[static_cast<std::size_t>(task)].trials;
    const TrialRuleRow& row = row_of(*trials.rule);
    const RuleTask by = rule_task(protocol, task, stimuli_in(scope));
    const RuleRequest& request = by.request;
    const Texts slots = request.slots;
    Texts among = trials.among, sizes;
    const std::string sample = trials.sample.empty() ? slots.front() : trials.sample;
    for (const std::string& slot : slots)
        if (trials.among.empty() && slot != sample)
            among.push_back(slot);
    for (const int size : request.set_sizes)
        sizes.push_back(fmt::format("{}", size));
    Texts sentences{fmt::format(
        fmt::runtime(row.words),
        fmt::arg("of", request.of.empty() ? std::string("nothing") : with_levels(request.of)),
        fmt::arg("standard", names_or(trials.standard, "")), fmt::arg("target", names_or(trials.target, "")),
        fmt::arg("distractors", names_or(trials.distractors, "all others")),
        fmt::arg("sizes", names_or(sizes, fmt::format("{}", slots.size()))),
        fmt::arg("size", trials.size > 0 ? trials.size : static_cast<int>(slots.size())),
        fmt::arg("sample", sample), fmt::arg("among", names_or(among, "")), fmt::arg("length", trials.length),
        fmt::arg("back", trials.back))};
    if (!request.differs.empty())
        sentences.push_back("differing in " + with_levels(request.differs));
    if (!trials.any.empty())
        sentences.push_back("whatever its " + names_or(trials.any, ""));
    Texts alike = by.unsaid;
    alike.insert(alike.end(), trials.same.begin(), trials.same.end());
    std::ranges::sort(alike);
    alike.erase(std::unique(alike.begin(), alike.end()), alike.end());
    if (!alike.empty() && row.name != "every")
        sentences.push_back(
            fmt::format("{} alike within a trial and crossed over trials", names_or(alike, "")));
    const bool has_sides = row.has_key("side") && !(trials.ordered && row.name == "pairs");
    const std::string_view whose =
        trials.per == DrawnFor::observer ? "for each observer" : "once for everyone";
    const auto rule = row.make(request);
    if (trials.draw)
        sentences.push_back(
            fmt::format("{} of {} combinations drawn {}", *trials.draw, rule->available(), whose));
    if (slots.size() > 1)
        sentences.push_back(fmt::format("slots {}{}", names_or(slots, ""),
                                        !has_sides                         ? ""
                                        : trials.side == SideRule::crossed ? ", sides crossed"
                                        : trials.side == SideRule::fixed
                                            ? ", sides fixed"
                                            : fmt::format(", sides drawn {}", whose)));
    if (row.keeps_order)
        sentences.push_back(fmt::format("the stream drawn {}", whose));
    RandomStream random(0, "design in words");
    if (const auto made = rule->trials(random); !made.empty() && !made.front().correct.empty())
        sentences.emplace_back("the correct answer is known");
    return sentences;
}

Texts words_of_table(const Protocol& protocol, int task) {
    const TrialTable& table = protocol.trial_tables[static_cast<std::size_t>(
        protocol.tasks[static_cast<std::size_t>(task)].trials.table)];
    Texts sentences{fmt::format("the {} of {}", counted(table.rows.size(), "row"),
                                std::filesystem::path(table.file).filename().string())};
    const Texts slots = ids_of_slots(protocol, task);
    if (slots.size() > 1)
        sentences.push_back("slots " + names_or(slots, ""));
    for (std::size_t i = 0; i < table.factors.size(); ++i) {
        Texts levels;
        for (const TrialTableRow& row : table.rows)
            levels.emplace_back(level_in(row, table.factors[i]));
        std::ranges::sort(levels);
        const auto count = std::unique(levels.begin(), levels.end()) - levels.begin();
        sentences.push_back(fmt::format("{} ({})", table.factors[i], counted(count, "level")));
    }
    if (std::ranges::any_of(table.rows, [](const TrialTableRow& row) { return !row.correct.empty(); }))
        sentences.emplace_back("the correct answer is known");
    return sentences;
}

std::string words_of_catch(const CatchSettings& checks) {
    const std::string file = checks.trials_file.filename().string();
    if (checks.share)
        return fmt::format("{:g} % of them catch trials, of {}", 100.0 * *checks.share, file);
    return checks.count ? fmt::format("{} catch trials of {} among them", *checks.count, file)
                        : fmt::format("catch trials among them, the rows of {}", file);
}

std::string words_of_draw(const DrawSettings& draw) {
    const std::string_view whose = draw.per == DrawnFor::observer ? "for each observer" : "once for everyone";
    if (draw.from.empty())
        return fmt::format("{} {}s drawn {}", draw.count.value_or(0), draw.of, whose);
    const auto count = [](std::optional<int> number) {
        return number ? fmt::format("{}", *number) : std::string("all");
    };
    return fmt::format("{} {}s that block {} has shown (old) and {} others (new), drawn {}",
                       count(draw.old_entries), draw.of, draw.from, count(draw.new_entries), whose);
}

} // namespace

std::vector<TaskWords> design_in_words(const Protocol& protocol, double trial_s) {
    std::vector<TaskWords> parts;
    for (int block = 0; block < block_count(protocol); ++block) {
        const BlockScope scope = scope_of(protocol, block);
        const BlockSettings& in = block_at(protocol, block);
        for (const int task : scope.tasks) {
            const Task& settings = protocol.tasks[static_cast<std::size_t>(task)];
            TaskWords words{in.id, settings.id, 0, 0.0, {}};
            words.sentences = settings.trials.rule         ? words_of_rule(protocol, task, scope)
                              : settings.trials.table >= 0 ? words_of_table(protocol, task)
                                                           : words_of_coverage(protocol, block, task, scope);
            if (settings.catch_trials.table >= 0)
                words.sentences.push_back(words_of_catch(settings.catch_trials));
            if (in.practice)
                words.sentences.emplace_back("practice, recorded");
            if (in.draw.is_written())
                words.sentences.push_back(words_of_draw(in.draw));
            if (const int times = settings.repetitions * in.repetitions; times > 1)
                words.sentences.push_back(fmt::format("{} times each", times));
            parts.push_back(std::move(words));
        }
    }
    const Factors factors = factors_of(protocol);
    // How many trials there are is a matter of the group.
    std::vector<Observer> observers = planned_observers(protocol);
    observers.resize(std::min(observers.size(), std::max<std::size_t>(1, protocol.groups.size())));
    for (const Observer& observer : observers) {
        for (const BlockPlan& plan : block_plans(protocol, observer.number, 0)) {
            const std::string& block = block_at(protocol, plan.block).id;
            for (TaskWords& words : parts) {
                double trials = 0.0;
                for (const Trial& trial : plan.trials)
                    if (words.block == block &&
                        protocol.tasks[static_cast<std::size_t>(trial.task)].id == words.task)
                        trials +=
                            weight_of(protocol, factors, trial) * block_at(protocol, plan.block).repetitions;
                words.trials = std::max(words.trials, static_cast<int>(trials + 0.5));
            }
        }
    }
    for (TaskWords& words : parts)
        words.length_s = trial_s * words.trials;
    return parts;
}

nlohmann::ordered_json to_json(const std::vector<TaskWords>& parts) {
    auto all = nlohmann::ordered_json::array();
    for (const TaskWords& words : parts) {
        nlohmann::ordered_json item;
        if (!words.block.empty())
            item["block"] = words.block;
        item["task"] = words.task;
        item["trials"] = words.trials;
        item["length_s"] = words.length_s;
        item["in_words"] = words.sentences;
        all.push_back(std::move(item));
    }
    return all;
}

} // namespace overt
