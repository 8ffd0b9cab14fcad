#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "experiment/base/counted.h"
#include "experiment/checks/protocol_checks.h"
#include "experiment/design/block_plan.h"
#include "experiment/design/latin_square.h"
#include "experiment/design/observer_groups.h"
#include "experiment/design/schedule.h"
#include "experiment/protocol/entry_ids.h"
#include "experiment/protocol/keys/protocol_keys.h"

namespace overt {

namespace {

void check_names(ProtocolExamination& examination, const std::string& path,
                 const std::vector<std::string>& names, const std::vector<std::string_view>& known,
                 std::string_view noun) {
    for (auto name = names.begin(); name != names.end(); ++name)
        if (is_known(examination, path, noun, *name, known) && std::find(names.begin(), name, *name) != name)
            examination.error({path}, fmt::format("{} \"{}\" is listed twice", noun, *name),
                              "to show more often, there is \"repetitions\"");
}

/// What a block or a group chooses of the lists; `path` begins the keys' paths.
void check_chosen(ProtocolExamination& examination, const std::string& path, const ChosenEntries& chosen) {
    for (std::size_t list = 0; list < stimulus_lists.size(); ++list)
        check_names(examination, fmt::format("{}.{}", path, stimulus_lists[list].plural), chosen[list],
                    ids_in_list(examination.protocol, list), stimulus_lists[list].name);
}

/// Factors by which trials can be ordered.
std::vector<std::string_view> names_to_order_by(const Factors& factors) {
    std::vector<std::string_view> names;
    for (const Factor& factor : factors.all())
        if (can_be_limited(factor))
            names.push_back(factor.name);
    return names;
}

/// Limits by name, in a block or in the schedule; `path` begins the keys' paths.
void check_named_limits(ProtocolExamination& examination, const std::string& path, const NamedNumbers& limits,
                        OrderLimit::Kind kind) {
    const Factors factors = factors_of(examination.protocol);
    const std::string_view key = kind == OrderLimit::Kind::longest_run ? "max_run" : "min_distance";
    for (const NamedNumber& limit : limits) {
        const std::string here = fmt::format("{}.{}.{}", path, key, limit.name);
        if (!is_known(examination, here, "factor", limit.name, names_to_order_by(factors)))
            continue;
        const std::string own = fmt::format("{}.{}", path, own_limit_key(limit.name, kind));
        if (!own_limit_key(limit.name, kind).empty() && examination.is_written(own))
            examination.error({here},
                              fmt::format("{} says it already, in {}", own_limit_key(limit.name, kind),
                                          examination.line_of(own, here)),
                              "take one of the two out");
        if (factors.at(limit.name).levels.size() == 1 && limit.number > 0)
            examination.error({here},
                              fmt::format("the factor \"{}\" has one level, \"{}\": there is nothing to keep "
                                          "apart",
                                          limit.name, factors.at(limit.name).levels.front().name));
    }
}

/// The factor that a block goes by; false if there is none of this name, or it has nothing to go by.
bool check_by(ProtocolExamination& examination, int index) {
    const BlockSettings& block = examination.protocol.blocks[static_cast<std::size_t>(index)];
    const Factors factors = factors_of(examination.protocol);
    const std::string path = fmt::format("block[{}].by", index);
    if (!is_known(examination, path, "factor", block.by, names_to_order_by(factors)))
        return false;
    const Factor& by = factors.at(block.by);
    if (examination.is_written(path) && by.levels.size() == 1) {
        std::string others;
        for (const Factor& other : factors.all())
            if (other.levels.size() > 1)
                others += fmt::format("{}{}", others.empty() ? "" : ", ", other.name);
        examination.error({path},
                          fmt::format("the factor \"{}\" has one level, \"{}\": there is nothing to go by",
                                      by.name, by.levels.front().name),
                          others.empty() ? "" : "with several levels there are " + others);
        return false;
    }
    return true;
}

std::size_t level_count_in(const Protocol& protocol, const BlockScope& scope, const std::string& by) {
    const Factors factors = factors_of(protocol);
    return levels_in(factors, scope, factors.at(by)).size();
}

void check_weights(ProtocolExamination& examination, const BlockSettings& block, int index) {
    const std::string path = fmt::format("block[{}].weights", index);
    if (block.weights.empty())
        return;
    const std::size_t levels =
        level_count_in(examination.protocol, scope_of(examination.protocol, index), block.by);
    if (block.weights.size() != levels) {
        examination.error({path},
                          fmt::format("there are {} weights for {} levels of the factor {}",
                                      block.weights.size(), levels, block.by),
                          "a weight for each level, in the order of the list");
        return;
    }
    if (std::all_of(block.weights.begin(), block.weights.end(),
                    [](double weight) { return weight == 0.0; })) {
        examination.error({path}, "all weights are 0: nothing would be shown");
    } else if (!block.draws && std::any_of(block.weights.begin(), block.weights.end(),
                                           [](double weight) { return weight != std::floor(weight); })) {
        examination.error({path},
                          "without \"draws\", weights say how often each trial comes, in whole numbers",
                          "multiply them, or say with \"draws\" how many trials are drawn");
    }
}

/// A key that says nothing under the order that the block has.
void check_idle(ProtocolExamination& examination, int index, std::string_view key, bool is_used,
                std::string_view used_by) {
    const std::string path = fmt::format("block[{}].{}", index, key);
    if (!is_used && examination.is_written(path))
        examination.error(
            {path}, fmt::format("\"{}\" is for blocks of order {}", key, used_by),
            fmt::format("this one is {}",
                        name_of(examination.protocol.blocks[static_cast<std::size_t>(index)].order)));
}

void check_block(ProtocolExamination& examination, int index) {
    const Protocol& protocol = examination.protocol;
    const BlockSettings& block = protocol.blocks[static_cast<std::size_t>(index)];
    const auto path = [&](std::string_view key) { return fmt::format("block[{}].{}", index, key); };
    check_names(examination, path("tasks"), block.tasks, ids_of<std::string_view>(protocol.tasks), "task");
    check_chosen(examination, fmt::format("block[{}]", index), block.chosen);
    check_named_limits(examination, fmt::format("block[{}]", index), block.max_run,
                       OrderLimit::Kind::longest_run);
    check_named_limits(examination, fmt::format("block[{}]", index), block.min_distance,
                       OrderLimit::Kind::least_distance);
    const bool has_factor = check_by(examination, index);
    const bool is_blocked = block.order == OrderMethod::blocked,
               is_weighted = block.order == OrderMethod::weighted;
    check_idle(examination, index, "by", is_blocked || is_weighted, "blocked or weighted");
    check_idle(examination, index, "levels", is_blocked, "blocked");
    check_idle(examination, index, "weights", is_weighted, "weighted");
    check_idle(examination, index, "draws", is_weighted, "weighted");
    if (is_weighted && has_factor)
        check_weights(examination, block, index);
    constexpr std::size_t most_levels = 60;
    if (is_blocked && has_factor && block.levels == LevelOrder::random) {
        const std::size_t levels = level_count_in(protocol, scope_of(protocol, index), block.by);
        if (levels > most_levels)
            examination.error({path("by"), path("levels")},
                              fmt::format("{} levels are too many for a random order of them; {} is the most",
                                          levels, most_levels),
                              "take levels = \"random-square\"");
    }
    if (block.continues && index == 0)
        examination.error({path("continues")}, "there is no block before this one that it could continue");
    else if (block.continues && protocol.schedule.block_order == LevelOrder::random)
        examination.error({path("continues"), "schedule.block_order"},
                          "a block cannot continue the one before it where their order is random",
                          "take block_order = \"random-square\"");
}

/// Those of the planned observers who see the same.
struct AlikeObservers {
    std::string of_group; ///< " of group "gold"", or nothing without groups
    int count = 0;
    int first = 1;  ///< number of one of them
    int blocks = 0; ///< that they have
};

std::vector<AlikeObservers> alike_observers(const Protocol& protocol) {
    if (protocol.groups.empty())
        return {{"", protocol.schedule.observers, 1, block_count(protocol)}};
    std::vector<AlikeObservers> groups(protocol.groups.size());
    const int planned =
        std::min(protocol.schedule.observers, group_capacity(protocol).value_or(protocol.schedule.observers));
    for (int number = planned; number >= 1; --number) {
        const auto group = static_cast<std::size_t>(group_place(protocol, number).group);
        const GroupSettings& settings = protocol.groups[group];
        groups[group] = {fmt::format(" of group \"{}\"", settings.id), groups[group].count + 1, number,
                         settings.blocks.empty() ? block_count(protocol)
                                                 : static_cast<int>(settings.blocks.size())};
    }
    std::erase_if(groups, [](const AlikeObservers& group) { return group.count == 0; });
    return groups;
}

/// Squares and rotations that a number of observers does not fill.
void check_fill(ProtocolExamination& examination, const AlikeObservers& observers, std::string_view what,
                int rows) {
    if (rows <= 1 || observers.count % rows == 0)
        return;
    const int below = observers.count / rows * rows;
    examination.warning(
        {"schedule.observers"},
        fmt::format("{}{} {} not fill {}, which takes {}", counted(observers.count, "observer"),
                    observers.of_group, observers.count == 1 ? "does" : "do", what, rows),
        below > 0 ? fmt::format("{} or {} observers{} would", below, below + rows, observers.of_group)
                  : fmt::format("{} observers{} would", rows, observers.of_group));
}

/// Rows after which the rotated list has gone round in a block; 1 where it does not.
int rows_of_rotation(const Protocol& protocol, int block, const BlockScope& scope) {
    const bool do_rotate =
        std::ranges::any_of(scope.tasks, [&](int task) { return rotates(protocol, block, task); });
    return do_rotate ? rows_of_square(protocol.schedule.material_rotation, rotated_entries(protocol, scope))
                     : 1;
}

void check_squares(ProtocolExamination& examination) {
    const Protocol& protocol = examination.protocol;
    const ScheduleSettings& schedule = protocol.schedule;
    for (const AlikeObservers& observers : alike_observers(protocol)) {
        const std::vector<BlockPlan> plans = block_plans(protocol, observers.first, 0);
        if (schedule.block_order >= LevelOrder::cyclic)
            check_fill(examination, observers, "the square of blocks",
                       rows_of_square(square_of(schedule.block_order), observers.blocks));
        int rotation = 1;
        for (const BlockPlan& plan : plans) {
            const BlockSettings& block = block_at(protocol, plan.block);
            if (block.order == OrderMethod::blocked && block.levels >= LevelOrder::cyclic)
                check_fill(examination, observers,
                           fmt::format("the square of levels of block \"{}\"", block.id),
                           rows_of_square(square_of(block.levels),
                                          static_cast<int>(level_count_in(protocol, plan.scope, block.by))));
            rotation = std::max(rotation, rows_of_rotation(protocol, plan.block, plan.scope));
        }
        if (!protocol.groups.empty())
            check_fill(examination, observers,
                       fmt::format("the rotation of {}", stimulus_lists.at(rotated_list(protocol)).plural),
                       rotation);
    }
}

/// Without groups, in the words of what is seen.
void check_rotation(ProtocolExamination& examination) {
    const Protocol& protocol = examination.protocol;
    if (!protocol.groups.empty())
        return;
    const int observers = protocol.schedule.observers;
    int rotation = 1;
    for (int index = 0; index < block_count(protocol); ++index)
        rotation = std::max(rotation, rows_of_rotation(protocol, index, scope_of(protocol, index)));
    if (observers % rotation != 0) {
        const int below = observers / rotation * rotation;
        examination.warning(
            {"schedule.observers"},
            fmt::format("{} cannot see {} {} equally often under the tasks that are asked once per object",
                        counted(observers, "observer"), ids_in_list(protocol, rotated_list(protocol)).size(),
                        stimulus_lists.at(rotated_list(protocol)).plural),
            below > 0 ? fmt::format("{} or {} observers would", below, below + rotation)
                      : fmt::format("{} observers would", rotation));
    }
}

} // namespace

void check_blocks(ProtocolExamination& examination) {
    const Protocol& protocol = examination.protocol;
    check_named_limits(examination, "schedule", protocol.schedule.max_run, OrderLimit::Kind::longest_run);
    check_named_limits(examination, "schedule", protocol.schedule.min_distance,
                       OrderLimit::Kind::least_distance);
    check_ids_differ(examination, "block", ids_of<std::string_view>(protocol.blocks));
    for (int index = 0; index < static_cast<int>(protocol.blocks.size()); ++index)
        check_block(examination, index);
    for (const Task& task : protocol.tasks) {
        const auto has_it = [&](const BlockSettings& block) {
            return block.tasks.empty() ||
                   std::find(block.tasks.begin(), block.tasks.end(), task.id) != block.tasks.end();
        };
        if (!protocol.blocks.empty() && std::none_of(protocol.blocks.begin(), protocol.blocks.end(), has_it))
            examination.warning({"block[0]"}, fmt::format("no block asks task \"{}\"", task.id));
    }
}

/// Practice is the same for all; who practises with what their group does not see, sees it nevertheless.
void check_practice_of_groups(ProtocolExamination& examination) {
    const Protocol& protocol = examination.protocol;
    const auto lacks = [](const std::vector<std::string>& seen, const std::string& id) {
        return !seen.empty() && std::find(seen.begin(), seen.end(), id) == seen.end();
    };
    for (std::size_t i = 0; i < protocol.practice.size(); ++i) {
        const PracticeSettings& practice = protocol.practice[i];
        for (const GroupSettings& group : protocol.groups) {
            if (!practice.block.empty() && lacks(group.blocks, practice.block))
                continue;
            const auto warn = [&](std::string_view key, std::string_view noun, const std::string& id) {
                examination.warning(
                    {fmt::format("practice[{}].{}", i, key)},
                    fmt::format("group \"{}\" practises with the {} \"{}\", which it does not have in its "
                                "trials",
                                group.id, noun, id),
                    fmt::format("add it to the group, or practise with what all groups have"));
            };
            if (lacks(group.tasks, practice.task))
                warn("task", "task", practice.task);
            for (std::size_t list = 0; list < stimulus_lists.size(); ++list)
                if (!practice.entries[list].empty() && lacks(group.chosen[list], practice.entries[list]))
                    warn(stimulus_lists[list].name, stimulus_lists[list].name, practice.entries[list]);
        }
    }
}

void check_groups(ProtocolExamination& examination) {
    check_practice_of_groups(examination);
    const Protocol& protocol = examination.protocol;
    check_ids_differ(examination, "group", ids_of<std::string_view>(protocol.groups));
    for (std::size_t i = 0; i < protocol.groups.size(); ++i) {
        const GroupSettings& group = protocol.groups[i];
        const auto path = [&](std::string_view key) { return fmt::format("group[{}].{}", i, key); };
        check_names(examination, path("blocks"), group.blocks, ids_of<std::string_view>(protocol.blocks),
                    "block");
        check_names(examination, path("tasks"), group.tasks, ids_of<std::string_view>(protocol.tasks),
                    "task");
        check_chosen(examination, fmt::format("group[{}]", i), group.chosen);
    }
    const std::optional<int> capacity = group_capacity(protocol);
    if (capacity && *capacity < protocol.schedule.observers)
        examination.error({"schedule.observers", "group[0].cap"},
                          fmt::format("{} observers are planned, and the caps of the groups take only {}",
                                      protocol.schedule.observers, *capacity),
                          "raise a cap, or plan fewer observers");
}

void check_schedule(ProtocolExamination& examination) {
    const Protocol& protocol = examination.protocol;
    const Factors factors = factors_of(protocol);
    const int distinct = std::max(1, static_cast<int>(protocol.groups.size()));
    for (int number = 1; number <= std::min(distinct, protocol.schedule.observers); ++number) {
        // Before trials are made, so that no product of large numbers is.
        double trials = 0.0;
        for (const BlockPlan& plan : block_plans(protocol, number, 0)) {
            const BlockSettings& block = block_at(protocol, plan.block);
            double weight = 0.0;
            for (const Trial& trial : plan.trials)
                weight += weight_of(protocol, factors, trial);
            trials += (block.draws ? static_cast<double>(*block.draws) : weight) * block.repetitions;
        }
        if (trials > most_trials_of_observer) {
            examination.error({protocol.blocks.empty() ? "task" : "block[0]"},
                              fmt::format("an observer would have {} trials; {} is the most", trials,
                                          most_trials_of_observer));
            return;
        }
        if (trials == 0.0) {
            const int group = group_place(protocol, number).group;
            examination.error({group >= 0 ? fmt::format("group[{}]", group) : "block"},
                              fmt::format("observer {} would have no trials", number),
                              group >= 0 ? "nothing is left of the blocks by what the group leaves out" : "");
            return;
        }
    }
    if (const auto conflict = find_order_conflict(protocol))
        examination.error(conflict->keys, conflict->message, conflict->hint);
    check_dropped_limits(examination);
    check_rotation(examination);
    check_squares(examination);
}

} // namespace overt
