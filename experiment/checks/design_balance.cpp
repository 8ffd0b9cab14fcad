#include "experiment/checks/design_balance.h"

#include <algorithm>
#include <limits>
#include <map>

#include <fmt/format.h>

#include "experiment/design/block_plan.h"
#include "experiment/design/latin_square.h"
#include "experiment/design/observer_groups.h"
#include "experiment/design/task_trials.h"

namespace overt {

namespace {

/// Whether which trials come is a matter of the seed, too.
bool is_drawn(const Protocol& protocol) {
    if (draws_trials(protocol))
        return true;
    return std::any_of(protocol.blocks.begin(), protocol.blocks.end(), [](const BlockSettings& block) {
        return block.order == OrderMethod::weighted && block.draws.has_value();
    });
}

std::size_t cell_of(const Factors& factors, int task, const Stimulus& stimulus) {
    return static_cast<std::size_t>(task) * factors.stimulus_count() +
           static_cast<std::size_t>(factors.level_of(factors.at("stimulus"), {}, stimulus));
}

/// Zeros for what a block shows to an observer.
Presentations::Part empty_part(const Protocol& protocol, const Factors& factors, const BlockScope& scope) {
    Presentations::Part part(protocol.tasks.size() * factors.stimulus_count(), -1);
    for (const int task : scope.tasks)
        for (const Stimulus& stimulus : stimuli_in(scope))
            part[cell_of(factors, task, stimulus)] = 0;
    return part;
}

/// Fewest and most presentations of a stimulus under a task.
struct Spread {
    int least = std::numeric_limits<int>::max(), most = 0;
    void add(int presentations) {
        least = std::min(least, presentations);
        most = std::max(most, presentations);
    }
    bool is_uneven() const { return least < most; }
};

Spread spread_in(const Presentations::Part& part, std::size_t task, std::size_t cells_per_task) {
    Spread spread;
    for (std::size_t cell = task * cells_per_task; cell < (task + 1) * cells_per_task; ++cell) {
        if (part[cell] >= 0)
            spread.add(part[cell]);
    }
    return spread;
}

std::string place_of_part(const Protocol& protocol, std::pair<int, int> block_and_group) {
    const auto [block, group] = block_and_group;
    std::string place;
    if (!protocol.blocks.empty())
        place += fmt::format(" in block \"{}\"", block_at(protocol, block).id);
    if (group >= 0)
        place += fmt::format(" to group \"{}\"", protocol.groups[static_cast<std::size_t>(group)].id);
    return place;
}

} // namespace

Presentations count_presentations(const Protocol& protocol, ScheduleMaker& maker, std::uint64_t seed) {
    Presentations counted;
    const Factors factors = factors_of(protocol);
    for (int task = 0; task < static_cast<int>(protocol.tasks.size()); ++task)
        for (int stimulus = 0; stimulus < static_cast<int>(factors.stimulus_count()); ++stimulus)
            counted.cells.push_back({task, factors.stimulus_at(stimulus), 0});
    for (const Observer& observer : planned_observers(protocol)) {
        const int group = group_place(protocol, observer.number).group;
        for (const BlockPlan& plan : block_plans(protocol, observer.number, 0))
            counted.parts.try_emplace({plan.block, group}, empty_part(protocol, factors, plan.scope));
        for (const Trial& trial :
             is_drawn(protocol) ? maker.make(observer, seed).trials : trials_of(protocol, observer.number)) {
            for (const PlacedStimulus& shown : trial.all_shown()) {
                const std::size_t cell = cell_of(factors, trial.task, shown.stimulus);
                ++counted.cells[cell].presentations;
                ++counted.parts.at({trial.block, group})[cell];
            }
        }
    }
    return counted;
}

std::vector<std::string> balance_warnings(const Protocol& protocol, const Presentations& presentations) {
    std::vector<std::string> warnings;
    const std::size_t cells_per_task = presentations.cells.size() / protocol.tasks.size();
    for (std::size_t task = 0; task < protocol.tasks.size(); ++task) {
        Spread over_all;
        for (std::size_t cell = task * cells_per_task; cell < (task + 1) * cells_per_task; ++cell)
            over_all.add(presentations.cells[cell].presentations);
        // What a rule or a table shows how often is its own business.
        if (!over_all.is_uneven() || protocol.tasks[task].trials.has_own_trials())
            continue;
        for (const auto& [place, part] : presentations.parts) {
            const Spread spread = spread_in(part, task, cells_per_task);
            const BlockSettings& block = block_at(protocol, place.first);
            if (!spread.is_uneven() || block.order == OrderMethod::weighted || block.draw.is_written())
                continue;
            std::string warning = fmt::format(
                "under task \"{}\" some stimuli are shown {} times and others {} times{}",
                protocol.tasks[task].id, spread.least, spread.most, place_of_part(protocol, place));
            if (protocol.blocks.empty() && protocol.groups.empty())
                warning += fmt::format(
                    ": let the number of observers be a multiple of {}",
                    rows_of_square(protocol.schedule.material_rotation,
                                   static_cast<int>(ids_in_list(protocol, rotated_list(protocol)).size())));
            warnings.push_back(std::move(warning));
        }
    }
    return warnings;
}

std::vector<std::string> aliased_factor_warnings(const Factors& factors, const Presentations& presentations) {
    // The level of each factor in each cell that is shown.
    std::vector<const Factor*> several;
    std::vector<std::vector<int>> levels;
    for (const Factor& factor : factors.all()) {
        if (factor.source == Factor::Source::stimulus || factor.source == Factor::Source::block)
            continue;
        std::vector<int> of_factor;
        for (const IncidenceCell& cell : presentations.cells)
            if (cell.presentations > 0)
                of_factor.push_back(factors.level_of(factor, {.task = cell.task, .stimulus = cell.stimulus}));
        if (of_factor.empty() ||
            std::ranges::count(of_factor, of_factor.front()) == static_cast<std::ptrdiff_t>(of_factor.size()))
            continue;
        several.push_back(&factor);
        levels.push_back(std::move(of_factor));
    }
    const auto determines = [&](std::size_t one, std::size_t other) {
        std::map<int, int> level_of_other;
        for (std::size_t cell = 0; cell < levels[one].size(); ++cell)
            if (level_of_other.try_emplace(levels[one][cell], levels[other][cell]).first->second !=
                levels[other][cell])
                return false;
        return true;
    };
    std::vector<std::string> warnings;
    for (std::size_t one = 0; one < several.size(); ++one) {
        for (std::size_t other = one + 1; other < several.size(); ++other) {
            // A column and its list: what tells each entry of a series from the next.
            const bool is_by_design = several[one]->source == Factor::Source::list &&
                                      several[other]->is_of_list(several[one]->list);
            if (!is_by_design && determines(one, other) && determines(other, one))
                warnings.push_back(fmt::format("{} and {} always change together: no analysis can tell them "
                                               "apart",
                                               several[one]->name, several[other]->name));
        }
    }
    return warnings;
}

} // namespace overt
