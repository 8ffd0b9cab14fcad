#include "experiment/checks/design_balance.h"

#include <algorithm>
#include <limits>

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

std::size_t cell_of(const Protocol& protocol, int task, const Stimulus& stimulus) {
    const std::size_t objects = protocol.objects.size(), materials = protocol.materials.size();
    return (static_cast<std::size_t>(task) * objects + static_cast<std::size_t>(stimulus.object)) *
               materials +
           static_cast<std::size_t>(stimulus.material);
}

/// Zeros for what a block shows to an observer.
Presentations::Part empty_part(const Protocol& protocol, const BlockScope& scope) {
    Presentations::Part part(protocol.tasks.size() * protocol.objects.size() * protocol.materials.size(), -1);
    for (const int task : scope.tasks)
        for (const int object : scope.objects)
            for (const int material : scope.materials)
                part[cell_of(protocol, task, {object, material})] = 0;
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
    for (int task = 0; task < static_cast<int>(protocol.tasks.size()); ++task) {
        for (int object = 0; object < static_cast<int>(protocol.objects.size()); ++object) {
            for (int material = 0; material < static_cast<int>(protocol.materials.size()); ++material)
                counted.cells.push_back({task, {object, material}, 0});
        }
    }
    for (const Observer& observer : planned_observers(protocol)) {
        const int group = group_place(protocol, observer.number).group;
        for (const BlockPlan& plan : block_plans(protocol, observer.number, 0))
            counted.parts.try_emplace({plan.block, group}, empty_part(protocol, plan.scope));
        for (const Trial& trial :
             is_drawn(protocol) ? maker.make(observer, seed).trials : trials_of(protocol, observer.number)) {
            const std::size_t cell = cell_of(protocol, trial.task, trial.stimulus);
            ++counted.cells[cell].presentations;
            ++counted.parts.at({trial.block, group})[cell];
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
        if (!over_all.is_uneven())
            continue;
        for (const auto& [place, part] : presentations.parts) {
            const Spread spread = spread_in(part, task, cells_per_task);
            if (!spread.is_uneven() || block_at(protocol, place.first).order == OrderMethod::weighted)
                continue;
            std::string warning = fmt::format(
                "under task \"{}\" some stimuli are shown {} times and others {} times{}",
                protocol.tasks[task].id, spread.least, spread.most, place_of_part(protocol, place));
            if (protocol.blocks.empty() && protocol.groups.empty())
                warning += fmt::format(": let the number of observers be a multiple of {}",
                                       rows_of_square(protocol.schedule.material_rotation,
                                                      static_cast<int>(protocol.materials.size())));
            warnings.push_back(std::move(warning));
        }
    }
    return warnings;
}

} // namespace overt
