#include "experiment/design/task_trials.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "experiment/base/random.h"
#include "experiment/design/match_levels.h"
#include "experiment/design/rules/trial_rules.h"

namespace overt {

namespace {

/// Index of the list that a factor is of; -1: there is no such factor of stimuli.
int list_of_factor(const Factors& factors, std::string_view name) {
    const Factor* const factor = factors.find(name);
    const bool is_of_list =
        factor && (factor->source == Factor::Source::list || factor->source == Factor::Source::column);
    return is_of_list ? static_cast<int>(factor->list) : -1;
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

std::vector<Trial> trials_by_rule(const Protocol& protocol, int task, const std::vector<Stimulus>& stimuli,
                                  RandomStream random) {
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

/// The rows of a table that a block shows, each as often as it comes.
std::vector<Trial> rows_of_table(const Protocol& protocol, int table, int block,
                                 const std::vector<Stimulus>& stimuli) {
    std::vector<Trial> trials;
    for (const TrialTableRow& row : protocol.trial_tables.at(static_cast<std::size_t>(table)).rows) {
        const bool is_here = (row.block < 0 || row.block == block) &&
                             std::ranges::all_of(row.shown, [&](const PlacedStimulus& shown) {
                                 return std::ranges::find(stimuli, shown.stimulus) != stimuli.end();
                             });
        if (!is_here)
            continue;
        Trial trial = placed(row.shown);
        trial.levels = row.levels;
        trial.correct = row.correct;
        trials.insert(trials.end(), static_cast<std::size_t>(row.repeat), trial);
    }
    return trials;
}

std::vector<Trial> trials_of_table(const Protocol& protocol, int task, int block,
                                   const std::vector<Stimulus>& stimuli) {
    const Task& settings = protocol.tasks[static_cast<std::size_t>(task)];
    const std::vector<Trial> once = rows_of_table(protocol, settings.trials.table, block, stimuli);
    std::vector<Trial> trials;
    for (int repetition = 0; repetition < settings.repetitions; ++repetition)
        trials.insert(trials.end(), once.begin(), once.end());
    return trials;
}

} // namespace

std::vector<std::string_view> stimulus_factor_names(const Factors& factors) {
    std::vector<std::string_view> names;
    for (const Factor& factor : factors.all())
        if (list_of_factor(factors, factor.name) >= 0)
            names.push_back(factor.name);
    return names;
}

std::optional<RuleFactor> stimulus_factor(const Factors& factors, const std::vector<Stimulus>& stimuli,
                                          std::string_view name) {
    if (list_of_factor(factors, name) < 0)
        return std::nullopt;
    const Factor& of = factors.at(name);
    RuleFactor factor{of.name, {}, {}};
    for (const FactorLevel& level : of.levels)
        if (level.name != no_level)
            factor.levels.push_back(level.name);
    for (const Stimulus& stimulus : stimuli) {
        const int level = factors.level_of(of, {}, stimulus);
        factor.of_stimulus.push_back(of.levels[static_cast<std::size_t>(level)].name == no_level ? -1
                                                                                                 : level);
    }
    return factor;
}

RuleTask rule_task(const Protocol& protocol, int task, const std::vector<Stimulus>& stimuli) {
    const Task& of_task = protocol.tasks.at(static_cast<std::size_t>(task));
    const TrialsSettings& settings = of_task.trials;
    const Factors factors = factors_of(protocol);
    RuleTask by;
    by.stimuli = stimuli;
    by.slots = slots_of_task(protocol, task);
    RuleRequest& request = by.request;
    request.stimuli = static_cast<int>(stimuli.size());
    for (const int slot : by.slots)
        request.slots.push_back(protocol.slots[static_cast<std::size_t>(slot)].id);

    const auto factors_called = [&](const std::vector<std::string>& names) {
        std::vector<RuleFactor> called;
        for (const std::string& name : names) {
            if (auto factor = stimulus_factor(factors, stimuli, name))
                called.push_back(*std::move(factor));
            else
                by.unknown.push_back(name);
        }
        return called;
    };
    std::vector<std::string> named = settings.of;
    for (std::size_t list = 0; settings.of.empty() && list < stimulus_lists.size(); ++list)
        if (varies(stimuli, list))
            named.emplace_back(stimulus_lists[list].name);
    request.of = factors_called(named);
    request.differs = factors_called(settings.differs);
    (void)factors_called(settings.any); // whether there are such

    // A list of which some factor says how it differs is not alike by itself.
    std::vector<bool> is_named(stimulus_lists.size());
    for (const std::vector<std::string>* names : {&std::as_const(named), &settings.differs, &settings.any})
        for (const std::string& name : *names)
            if (const int list = list_of_factor(factors, name); list >= 0)
                is_named[static_cast<std::size_t>(list)] = true;
    std::vector<std::vector<int>> alike;
    for (std::size_t list = 0; list < stimulus_lists.size(); ++list) {
        if (is_named[list])
            continue;
        alike.push_back(stimulus_factor(factors, stimuli, stimulus_lists[list].name)->of_stimulus);
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
    request.lures = settings.lures;
    for (const ProcedureSettings& procedure : protocol.procedures)
        if (is_among(settings.procedures, procedure.id))
            request.procedure_trials += procedure.trials;
    return by;
}

std::vector<Trial> own_trials(const Protocol& protocol, int task, int block,
                              const std::vector<Stimulus>& stimuli, int observer_number, std::uint64_t seed) {
    std::vector<Trial> trials =
        protocol.tasks.at(static_cast<std::size_t>(task)).trials.rule
            ? trials_by_rule(protocol, task, stimuli, random_of(protocol, task, block, observer_number, seed))
            : trials_of_table(protocol, task, block, stimuli);
    for (Trial& trial : trials) {
        trial.task = task;
        trial.block = block;
        fill_matched_slots(protocol, trial);
    }
    return trials;
}

std::vector<Trial> catch_trials(const Protocol& protocol, int task, int block,
                                const std::vector<Stimulus>& stimuli, const std::vector<Trial>& trials,
                                int observer_number, std::uint64_t seed) {
    const Task& of_task = protocol.tasks.at(static_cast<std::size_t>(task));
    const CatchSettings& settings = of_task.catch_trials;
    if (settings.table < 0)
        return {};
    std::vector<Trial> all = rows_of_table(protocol, settings.table, block, stimuli);
    if (all.empty())
        return {};
    const auto others = std::ranges::count(trials, task, &Trial::task);
    std::size_t count = static_cast<std::size_t>(settings.count.value_or(static_cast<int>(all.size())));
    if (settings.share) // s of n + c trials are c: c = n s / (1 - s)
        count = static_cast<std::size_t>(
            std::lround(static_cast<double>(others) * *settings.share / (1.0 - *settings.share)));
    RandomStream random(
        seed, fmt::format("catch trials of task {} in block {}", of_task.id, block_at(protocol, block).id),
        static_cast<std::uint64_t>(observer_number));
    random.shuffle(std::span(all));
    std::vector<Trial> checks;
    for (std::size_t i = 0; i < count; ++i) {
        checks.push_back(all[i % all.size()]);
        checks.back().task = task;
        checks.back().block = block;
        checks.back().role = TrialRole::catch_trial;
        fill_matched_slots(protocol, checks.back());
    }
    return checks;
}

bool draws_trials(const Protocol& protocol) {
    const bool by_task = std::ranges::any_of(protocol.tasks, [](const Task& task) {
        return (task.trials.rule && task.trials.per == DrawnFor::observer) || task.catch_trials.table >= 0;
    });
    return by_task || std::ranges::any_of(protocol.blocks, [](const BlockSettings& block) {
               return block.draw.is_written() && block.draw.per == DrawnFor::observer;
           });
}

} // namespace overt
