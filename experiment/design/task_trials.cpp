#include "experiment/design/task_trials.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "experiment/base/random.h"
#include "experiment/design/rules/trial_rules.h"

namespace overt {

namespace {

/// Index of the list that a factor is of; -1: there is no such factor.
int list_of_factor(const Protocol& protocol, std::string_view name) {
    for (std::size_t list = 0; list < stimulus_lists.size(); ++list) {
        if (stimulus_lists[list].name == name)
            return static_cast<int>(list);
        for (const ListEntry* entry : entries_of(protocol, list))
            if (std::ranges::find(entry->columns, name, &EntryColumn::name) != entry->columns.end())
                return static_cast<int>(list);
    }
    return -1;
}

/// The levels of a factor in a list, and the level of each entry.
struct ListLevels {
    std::vector<std::string> names;
    std::vector<int> of_entry; ///< -1: none
};

ListLevels levels_of_factor(const Protocol& protocol, std::size_t list, std::string_view name) {
    ListLevels levels;
    std::vector<std::pair<std::optional<double>, std::string>> known;
    const std::vector<const ListEntry*> entries = entries_of(protocol, list);
    const auto said_of =
        [&](const ListEntry& entry) -> std::optional<std::pair<std::optional<double>, std::string>> {
        if (name == stimulus_lists[list].name)
            return std::pair(std::optional<double>(), entry.id);
        const auto column = std::ranges::find(entry.columns, name, &EntryColumn::name);
        if (column == entry.columns.end())
            return std::nullopt;
        return std::pair(column->number, column->text);
    };
    for (const ListEntry* entry : entries) {
        const auto said = said_of(*entry);
        if (said && std::ranges::find(known, *said) == known.end())
            known.push_back(*said);
    }
    // Numbers from the smallest up; words as listed.
    if (std::ranges::all_of(known, [](const auto& level) { return level.first.has_value(); }))
        std::ranges::sort(known);
    for (const auto& level : known)
        levels.names.push_back(level.second);
    for (const ListEntry* entry : entries) {
        const auto said = said_of(*entry);
        levels.of_entry.push_back(said ? static_cast<int>(std::ranges::find(known, *said) - known.begin())
                                       : -1);
    }
    return levels;
}

bool is_among(const std::vector<std::string>& names, std::string_view name) {
    return std::ranges::find(names, name) != names.end();
}

/// Whether a list has several entries among the stimuli.
bool varies(const std::vector<Stimulus>& stimuli, std::size_t list) {
    const auto index = stimulus_lists[list].index;
    return std::ranges::any_of(
        stimuli, [&](const Stimulus& stimulus) { return stimulus.*index != stimuli.front().*index; });
}

/// Numbers from 0 of what is alike in all of these levels.
std::vector<int> contexts_of(const std::vector<std::vector<int>>& alike, std::size_t stimuli) {
    std::map<std::vector<int>, int> known;
    std::vector<int> contexts;
    for (std::size_t i = 0; i < stimuli; ++i) {
        std::vector<int> levels;
        for (const std::vector<int>& factor : alike)
            levels.push_back(factor[i]);
        contexts.push_back(known.emplace(std::move(levels), static_cast<int>(known.size())).first->second);
    }
    return contexts;
}

Trial placed(const std::vector<PlacedStimulus>& shown) {
    Trial trial;
    trial.stimulus = shown.front().stimulus;
    trial.slot = shown.front().slot;
    trial.beside.assign(shown.begin() + 1, shown.end());
    return trial;
}

RandomStream random_of(const Protocol& protocol, int task, int block, int observer_number,
                       std::uint64_t seed) {
    const TrialsSettings& settings = protocol.tasks.at(static_cast<std::size_t>(task)).trials;
    const std::string& in_block = block_at(protocol, block).id;
    const std::string purpose =
        fmt::format("trials of task {}{}", protocol.tasks[static_cast<std::size_t>(task)].id,
                    in_block.empty() ? "" : " in block " + in_block);
    if (settings.per == DrawnFor::everyone)
        return RandomStream(static_cast<std::uint64_t>(protocol.schedule.rotation_seed), purpose);
    return RandomStream(seed, purpose, static_cast<std::uint64_t>(observer_number));
}

std::vector<Trial> trials_by_rule(const Protocol& protocol, int task, int block,
                                  const std::vector<Stimulus>& stimuli, RandomStream random) {
    const RuleTask by = rule_task(protocol, task, stimuli);
    const auto rule = row_of(*protocol.tasks[static_cast<std::size_t>(task)].trials.rule).make(by.request);
    std::vector<Trial> trials;
    for (const RuledTrial& ruled : rule->trials(random)) {
        std::vector<PlacedStimulus> shown;
        for (std::size_t slot = 0; slot < by.slots.size(); ++slot)
            if (ruled.shown[slot] >= 0)
                shown.push_back({stimuli[static_cast<std::size_t>(ruled.shown[slot])], by.slots[slot]});
        Trial trial = placed(shown);
        trial.correct = ruled.correct;
        if (ruled.side)
            trial.levels.push_back({"side", by.request.slots[static_cast<std::size_t>(*ruled.side)]});
        for (const auto& [factor, level] : ruled.levels)
            trial.levels.push_back({factor, level});
        trials.push_back(std::move(trial));
    }
    return trials;
}

std::vector<Trial> trials_of_table(const Protocol& protocol, int task, int block,
                                   const std::vector<Stimulus>& stimuli) {
    const Task& settings = protocol.tasks[static_cast<std::size_t>(task)];
    std::vector<Trial> trials;
    for (int repetition = 0; repetition < settings.repetitions; ++repetition) {
        for (const TrialTableRow& row :
             protocol.trial_tables.at(static_cast<std::size_t>(settings.trials.table)).rows) {
            const bool is_here = (row.block < 0 || row.block == block) &&
                                 std::ranges::all_of(row.shown, [&](const auto& shown) {
                                     return std::ranges::find(stimuli, shown.stimulus) != stimuli.end();
                                 });
            if (!is_here)
                continue;
            Trial trial = placed(row.shown);
            trial.levels = row.levels;
            trial.correct = row.correct;
            trials.insert(trials.end(), static_cast<std::size_t>(row.repeat), trial);
        }
    }
    return trials;
}

} // namespace

std::vector<std::string> stimulus_factor_names(const Protocol& protocol) {
    std::vector<std::string> names;
    for (std::size_t list = 0; list < stimulus_lists.size(); ++list) {
        names.emplace_back(stimulus_lists[list].name);
        for (const ListEntry* entry : entries_of(protocol, list))
            for (const EntryColumn& column : entry->columns)
                if (!is_among(names, column.name))
                    names.push_back(column.name);
    }
    return names;
}

std::optional<RuleFactor> stimulus_factor(const Protocol& protocol, const std::vector<Stimulus>& stimuli,
                                          std::string_view name) {
    const int list = list_of_factor(protocol, name);
    if (list < 0)
        return std::nullopt;
    ListLevels levels = levels_of_factor(protocol, static_cast<std::size_t>(list), name);
    RuleFactor factor{std::string(name), std::move(levels.names), {}};
    for (const Stimulus& stimulus : stimuli)
        factor.of_stimulus.push_back(levels.of_entry[static_cast<std::size_t>(
            stimulus.*stimulus_lists[static_cast<std::size_t>(list)].index)]);
    return factor;
}

RuleTask rule_task(const Protocol& protocol, int task, const std::vector<Stimulus>& stimuli) {
    const Task& of_task = protocol.tasks.at(static_cast<std::size_t>(task));
    const TrialsSettings& settings = of_task.trials;
    RuleTask by;
    by.stimuli = stimuli;
    by.slots = slots_of_task(protocol, task);
    RuleRequest& request = by.request;
    request.stimuli = static_cast<int>(stimuli.size());
    for (const int slot : by.slots)
        request.slots.push_back(protocol.slots[static_cast<std::size_t>(slot)].id);

    const auto factors_called = [&](const std::vector<std::string>& names) {
        std::vector<RuleFactor> factors;
        for (const std::string& name : names) {
            if (auto factor = stimulus_factor(protocol, stimuli, name))
                factors.push_back(*std::move(factor));
            else
                by.unknown.push_back(name);
        }
        return factors;
    };
    std::vector<std::string> of = settings.of;
    for (std::size_t list = 0; settings.of.empty() && list < stimulus_lists.size(); ++list)
        if (varies(stimuli, list))
            of.emplace_back(stimulus_lists[list].name);
    request.of = factors_called(of);
    request.differs = factors_called(settings.differs);
    (void)factors_called(settings.any); // whether there are such

    // A list of which some factor says how it differs is not alike by itself.
    std::vector<bool> is_named(stimulus_lists.size());
    for (const std::vector<std::string>* names : {&of, &settings.differs, &settings.any})
        for (const std::string& name : *names)
            if (const int list = list_of_factor(protocol, name); list >= 0)
                is_named[static_cast<std::size_t>(list)] = true;
    std::vector<std::vector<int>> alike;
    for (std::size_t list = 0; list < stimulus_lists.size(); ++list) {
        if (is_named[list])
            continue;
        alike.push_back(stimulus_factor(protocol, stimuli, stimulus_lists[list].name)->of_stimulus);
        if (varies(stimuli, list) && !is_among(settings.same, stimulus_lists[list].name))
            by.unsaid.emplace_back(stimulus_lists[list].name);
    }
    for (RuleFactor& factor : factors_called(settings.same))
        alike.push_back(std::move(factor.of_stimulus));
    request.context = contexts_of(alike, stimuli.size());

    request.side = settings.side;
    request.draw = settings.draw;
    request.repetitions = of_task.repetitions;
    request.is_ordered = settings.ordered;
    request.with_identical = settings.identical;
    request.standards = settings.standard;
    request.targets = settings.target;
    request.distractors = settings.distractors;
    request.size = settings.size;
    for (const double size : settings.set_sizes)
        request.set_sizes.push_back(static_cast<int>(size));
    request.absent = settings.absent;
    request.in = settings.in;
    request.sample = settings.sample;
    request.among = settings.among;
    request.length = settings.length;
    request.back = settings.back;
    request.repeats = settings.repeats;
    return by;
}

std::vector<Trial> own_trials(const Protocol& protocol, int task, int block,
                              const std::vector<Stimulus>& stimuli, int observer_number, std::uint64_t seed) {
    std::vector<Trial> trials = protocol.tasks.at(static_cast<std::size_t>(task)).trials.rule
                                    ? trials_by_rule(protocol, task, block, stimuli,
                                                     random_of(protocol, task, block, observer_number, seed))
                                    : trials_of_table(protocol, task, block, stimuli);
    for (Trial& trial : trials) {
        trial.task = task;
        trial.block = block;
    }
    return trials;
}

bool draws_trials(const Protocol& protocol, int task) {
    const TrialsSettings& settings = protocol.tasks.at(static_cast<std::size_t>(task)).trials;
    return settings.rule && settings.per == DrawnFor::observer;
}

} // namespace overt
