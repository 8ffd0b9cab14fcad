#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "experiment/base/random.h"
#include "experiment/design/block_plan.h"
#include "experiment/design/drawn_lists.h"
#include "experiment/design/latin_square.h"
#include "experiment/design/match_levels.h"
#include "experiment/design/observer_groups.h"
#include "experiment/design/point_trials.h"
#include "experiment/design/schedule.h"
#include "experiment/design/task_trials.h"
#include "experiment/protocol/entry_ids.h"

namespace overt {

namespace {

int count_of(const auto& list) { return static_cast<int>(list.size()); }

/// Indices of the entries that an id list names, in its order; of all, if it names none. Those that `group`
/// names none of are left out.
std::vector<int> chosen(const std::vector<std::string>& entries, const std::vector<std::string>& ids,
                        const std::vector<std::string>* group) {
    std::vector<int> indices;
    const auto add = [&](const auto& wanted) {
        for (int i = 0; i < count_of(entries); ++i) {
            const std::string& id = entries[static_cast<std::size_t>(i)];
            if (wanted(id) &&
                (!group || group->empty() || std::find(group->begin(), group->end(), id) != group->end()))
                indices.push_back(i);
        }
    };
    if (ids.empty())
        add([](const std::string&) { return true; });
    for (const std::string& wanted : ids)
        add([&](const std::string& id) { return id == wanted; });
    return indices;
}

/// What a block shows to a group, or to somebody whom none keeps anything from.
BlockScope scope_for(const Protocol& protocol, int block, const GroupSettings* group) {
    const BlockSettings& settings = block_at(protocol, block);
    BlockScope scope;
    scope.tasks = chosen(ids_of(protocol.tasks), settings.tasks, group ? &group->tasks : nullptr);
    for (std::size_t list = 0; list < stimulus_lists.size(); ++list) {
        const std::vector<std::string_view> ids = ids_in_list(protocol, list);
        scope.lists[list] =
            chosen({ids.begin(), ids.end()}, settings.chosen[list], group ? &group->chosen[list] : nullptr);
    }
    return scope;
}

constexpr std::size_t object_list = 0;
static_assert(stimulus_lists[object_list].index == &Stimulus::object);

/// The rotated list's entry of a cell, c = task * S + object with the task's place among the rotated ones:
/// column (c + floor(c / L)) mod M of the row, with L the least common multiple of S and M. So the M rows of
/// a square fill all M entries of a cell once; each row has all entries equally often, to one; and an object
/// changes its entry from task to task.
int rotated(const Protocol& protocol, int row, int cell, const BlockScope& scope) {
    const int objects = count_of(scope.lists[object_list]), entries = rotated_entries(protocol, scope);
    const int round = std::lcm(objects, entries);
    const int column = (cell + cell / round) % entries;
    return row_of_square(protocol.schedule.material_rotation, entries, row,
                         static_cast<std::uint64_t>(protocol.schedule.rotation_seed),
                         std::string(protocol.schedule.rotated_list) +
                             " rotation")[static_cast<std::size_t>(column)];
}

/// Whose trials are asked for.
struct ForObserver {
    int number = 1;
    std::uint64_t seed = 0;
};

std::vector<Trial> trials_in(const Protocol& protocol, int block, const BlockScope& scope, int row,
                             const ForObserver& observer) {
    std::vector<Trial> trials;
    const auto add_trials = [&](std::vector<Trial> of_task, int task) {
        for (Trial& trial :
             with_points(protocol, std::move(of_task), task, block, observer.number, observer.seed))
            trials.push_back(std::move(trial));
    };
    for (const int task : scope.tasks) {
        if (protocol.tasks[static_cast<std::size_t>(task)].trials.has_own_trials()) {
            add_trials(own_trials(protocol, task, block, stimuli_in(scope), observer.number, observer.seed),
                       task);
            continue;
        }
        std::vector<Trial> of_task;
        const TaskCoverage own = protocol.tasks[static_cast<std::size_t>(task)].stimuli;
        const bool is_rotated = rotates(protocol, block, task);
        // A rotated task's cells are numbered by its place among the rotated tasks, whatever block it is in.
        int rotating_task = task;
        if (own == TaskCoverage::once_per_object)
            rotating_task = static_cast<int>(
                std::count_if(protocol.tasks.begin(), protocol.tasks.begin() + task, [](const Task& earlier) {
                    return earlier.stimuli == TaskCoverage::once_per_object;
                }));
        // Of a rotated task, an object has one entry of the list in all that the other lists make of it.
        const std::size_t list = rotated_list(protocol);
        std::vector<int> entry_of_object(protocol.objects.size(), -1);
        const std::vector<int>& objects = scope.lists[object_list];
        for (int i = 0; is_rotated && !scope.lists[list].empty() && i < count_of(objects); ++i) {
            const int cell = rotating_task * count_of(objects) + i;
            entry_of_object[static_cast<std::size_t>(objects[static_cast<std::size_t>(i)])] =
                scope.lists[list][static_cast<std::size_t>(rotated(protocol, row, cell, scope))];
        }
        for (const Stimulus& stimulus : stimuli_in(scope)) {
            if (!is_rotated || entry_of_object[static_cast<std::size_t>(stimulus.object)] ==
                                   stimulus.*stimulus_lists[list].index)
                of_task.push_back({0, task, stimulus, block});
        }
        for (Trial& trial : of_task)
            fill_slots(protocol, trial);
        for (int i = 0; i < protocol.tasks[static_cast<std::size_t>(task)].repetitions; ++i)
            add_trials(of_task, task);
    }
    for (const int task : scope.tasks)
        for (Trial& trial :
             catch_trials(protocol, task, block, stimuli_in(scope), trials, observer.number, observer.seed))
            trials.push_back(std::move(trial));
    for (std::size_t i = 0; i < trials.size(); ++i)
        trials[i].index = static_cast<int>(i);
    return trials;
}

std::vector<int> order_of_blocks(const Protocol& protocol, const std::vector<int>& blocks, int row,
                                 std::uint64_t seed) {
    std::vector<int> order = blocks;
    const LevelOrder by = protocol.schedule.block_order;
    if (by == LevelOrder::fixed || blocks.empty())
        return order;
    if (by == LevelOrder::random) {
        RandomStream random(seed, "block order", static_cast<std::uint64_t>(row));
        random.shuffle(std::span(order));
        return order;
    }
    const std::vector<int> places =
        row_of_square(square_of(by), count_of(blocks), row,
                      static_cast<std::uint64_t>(protocol.schedule.rotation_seed), "block order");
    for (std::size_t i = 0; i < order.size(); ++i)
        order[i] = blocks[static_cast<std::size_t>(places[i])];
    return order;
}

} // namespace

BlockScope scope_of(const Protocol& protocol, int block) { return scope_for(protocol, block, nullptr); }

std::size_t rotated_list(const Protocol& protocol) {
    return static_cast<std::size_t>(
        std::ranges::find(stimulus_lists, protocol.schedule.rotated_list, &StimulusList::name) -
        stimulus_lists.begin());
}

int rotated_entries(const Protocol& protocol, const BlockScope& scope) {
    return count_of(scope.lists.at(rotated_list(protocol)));
}

std::vector<Stimulus> stimuli_in(const BlockScope& scope) {
    std::vector<Stimulus> stimuli{{}};
    for (std::size_t list = 0; list < stimulus_lists.size(); ++list) {
        std::vector<Stimulus> more;
        for (Stimulus stimulus : stimuli)
            for (const int entry : scope.lists[list]) {
                stimulus.*stimulus_lists[list].index = entry;
                more.push_back(stimulus);
            }
        stimuli = std::move(more);
    }
    return stimuli;
}

const BlockSettings whole_session;

int block_count(const Protocol& protocol) { return protocol.blocks.empty() ? 1 : count_of(protocol.blocks); }

const BlockSettings& block_at(const Protocol& protocol, int block) {
    return protocol.blocks.empty() ? whole_session : protocol.blocks.at(static_cast<std::size_t>(block));
}

void fill_slots(const Protocol& protocol, Trial& trial) {
    const std::vector<int> slots = slots_of_task(protocol, trial.task);
    trial.slot = slots.empty() ? 0 : slots.front();
    trial.beside.clear();
    for (std::size_t i = 1; i < slots.size(); ++i)
        trial.beside.push_back({trial.stimulus, slots[i]});
    fill_matched_slots(protocol, trial);
}

int most_stimuli_at_once(const Protocol& protocol) {
    std::size_t most = 1;
    for (const BlockPlan& plan : block_plans(protocol, 1, 0)) {
        for (const Trial& trial : plan.trials) {
            std::set<Stimulus> stimuli{trial.stimulus};
            for (const PlacedStimulus& placed : trial.beside)
                stimuli.insert(placed.stimulus);
            most = std::max(most, stimuli.size());
        }
    }
    return static_cast<int>(most);
}

std::vector<int> levels_in(const Factors& factors, const BlockScope& scope, const Factor& factor) {
    if (factor.source == Factor::Source::task)
        return scope.tasks;
    std::vector<int> levels;
    if (factor.source == Factor::Source::stimulus) {
        for (const Stimulus& stimulus : stimuli_in(scope))
            levels.push_back(factors.level_of(factor, {}, stimulus));
        return levels;
    }
    if (factor.source == Factor::Source::own) {
        levels.resize(factor.levels.size());
        std::iota(levels.begin(), levels.end(), 0);
        return levels;
    }
    for (const int entry : scope.lists[factor.list]) {
        const int level = factor.level_of_entry.at(static_cast<std::size_t>(entry));
        if (std::ranges::find(levels, level) == levels.end())
            levels.push_back(level);
    }
    if (factor.source == Factor::Source::column)
        std::ranges::sort(levels);
    return levels;
}

double weight_of(const Protocol& protocol, const Factors& factors, const Trial& trial) {
    const BlockSettings& block = block_at(protocol, trial.block);
    if (block.order != OrderMethod::weighted || block.weights.empty())
        return 1.0;
    const Factor& by = factors.at(block.by);
    const std::vector<int> levels = levels_in(factors, scope_of(protocol, trial.block), by);
    const auto at = std::find(levels.begin(), levels.end(), factors.level_of(by, trial));
    return block.weights.at(static_cast<std::size_t>(at - levels.begin()));
}

int length_of(const Protocol& protocol, const BlockPlan& plan) {
    const BlockSettings& block = block_at(protocol, plan.block);
    if (block.order == OrderMethod::weighted && block.draws)
        return *block.draws * block.repetitions;
    if (block.order != OrderMethod::weighted)
        return count_of(plan.trials) * block.repetitions;
    const Factors factors = factors_of(protocol);
    double length = 0.0;
    for (const Trial& trial : plan.trials)
        length += weight_of(protocol, factors, trial);
    return static_cast<int>(std::lround(length)) * block.repetitions;
}

bool rotates(const Protocol& protocol, int block, int task) {
    return block_at(protocol, block)
               .stimuli.value_or(protocol.tasks.at(static_cast<std::size_t>(task)).stimuli) ==
           TaskCoverage::once_per_object;
}

std::vector<BlockScopeOf> blocks_of_group(const Protocol& protocol, int number) {
    const GroupSettings* group = number < 0 ? nullptr : &protocol.groups.at(static_cast<std::size_t>(number));
    std::vector<int> blocks{0};
    if (!protocol.blocks.empty())
        blocks = chosen(ids_of(protocol.blocks), {}, group ? &group->blocks : nullptr);
    std::vector<BlockScopeOf> scopes;
    for (const int block : blocks)
        scopes.push_back({block, scope_for(protocol, block, group)});
    return scopes;
}

std::vector<BlockPlan> block_plans(const Protocol& protocol, int observer_number, std::uint64_t seed,
                                   RotationRule rule) {
    using Kind = RotatedFactor::Kind;
    const GroupPlace place = group_place(protocol, observer_number);
    const Rotations rotations(protocol, place.group, rule);
    const std::vector<BlockScopeOf> scopes = blocks_of_group(protocol, place.group);
    std::vector<int> blocks;
    for (const BlockScopeOf& one : scopes)
        blocks.push_back(one.block);
    std::vector<BlockPlan> plans;
    for (const int block :
         order_of_blocks(protocol, blocks, rotations.row_of(Kind::blocks, -1, place.row), seed)) {
        BlockPlan plan{block, {}, {}, rotations.row_of(Kind::levels, block, place.row)};
        plan.scope = std::ranges::find(scopes, block, &BlockScopeOf::block)->scope;
        const auto drawn = drawn_list(protocol, scopes, block, observer_number, seed);
        if (drawn)
            plan.scope.lists[drawn->list] = drawn->entries;
        plan.trials = trials_in(protocol, block, plan.scope, rotations.row_of(Kind::entries, -1, place.row),
                                {observer_number, seed});
        if (drawn)
            mark_old_and_new(*drawn, plan.trials);
        if (block_at(protocol, block).practice)
            for (Trial& trial : plan.trials)
                trial.role = TrialRole::practice;
        if (!plan.trials.empty())
            plans.push_back(std::move(plan));
    }
    return plans;
}

} // namespace overt
