/// From a protocol to what is to be ordered: an observer's blocks, their trials, and what their order has to
/// keep to.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "experiment/design/orders/order_problem.h"
#include "experiment/design/rotation.h"
#include "experiment/factors.h"
#include "experiment/protocol/protocol.h"
#include "experiment/trial.h"

namespace overt {

/// The only block of a protocol without any.
extern const BlockSettings whole_session;

/// The blocks of a protocol; whole_session alone if it has none.
const BlockSettings& block_at(const Protocol& protocol, int block);
int block_count(const Protocol& protocol);

/// What of a protocol a block shows to an observer. Indices into the protocol's lists, in the order of the
/// block's.
struct BlockScope {
    std::vector<int> tasks;
    std::array<std::vector<int>, stimulus_lists.size()> lists; ///< by row of stimulus_lists
};

/// The list whose entries go round over the observers in tasks that are asked once per object, as a row of
/// stimulus_lists, and how many of them a scope has.
std::size_t rotated_list(const Protocol& protocol);
int rotated_entries(const Protocol& protocol, const BlockScope& scope);

/// All stimuli of a scope, list by list, the last running fastest.
std::vector<Stimulus> stimuli_in(const BlockScope& scope);

/// What a block shows to somebody whom no group keeps anything from.
BlockScope scope_of(const Protocol& protocol, int block);

/// A block with what it shows to a group.
struct BlockScopeOf {
    int block = 0;
    BlockScope scope;
};

/// The blocks of a group (-1: without groups), as listed, with what they show to it. Blocks that the group
/// leaves without trials are among them.
std::vector<BlockScopeOf> blocks_of_group(const Protocol& protocol, int number);

/// Whether a task is asked once per object in a block, an entry of the rotated list going round over the
/// observers.
bool rotates(const Protocol& protocol, int block, int task);

/// A block as one observer has it.
struct BlockPlan {
    int block = 0;
    BlockScope scope;
    std::vector<Trial> trials; ///< each once, task by task, list by list
    int levels_row = 0;        ///< of the square by which the levels of a blocked order go
};

/// The blocks that an observer has, in their order. `seed` decides a random order of blocks only. Blocks that
/// the observer's group leaves without trials are not among them. Throws InputError as group_place does.
std::vector<BlockPlan> block_plans(const Protocol& protocol, int observer_number, std::uint64_t seed,
                                   RotationRule rule = RotationRule::crossed);

/// Puts the trial's stimulus into each of its task's slots: what a task without a rule of its own shows.
void fill_slots(const Protocol& protocol, Trial& trial);

/// The most stimuli that a trial of an observer shows at once, each counted once.
int most_stimuli_at_once(const Protocol& protocol);

/// More than anyone sits through, and a bound for all that is reckoned per trial.
inline constexpr int most_trials_of_observer = 2000;

/// How many trials a block has: its trials with their repetitions or weights, or its draws.
int length_of(const Protocol& protocol, const BlockPlan& plan);

/// The levels of a factor in a block, each once, as Factors::level_of gives them; in the block's order of the
/// list, and those of a column in the factor's.
std::vector<int> levels_in(const Factors& factors, const BlockScope& scope, const Factor& factor);

/// How often a trial comes in a block, or is drawn in proportion to its siblings of the same level. 1 but in
/// weighted blocks. `factors`: the protocol's.
double weight_of(const Protocol& protocol, const Factors& factors, const Trial& trial);

/// What is to be ordered together: a block and those after it that continue it.
struct OrderChain {
    std::vector<BlockPlan> blocks;
    OrderProblem problem;
    std::vector<Trial> trials; ///< by item of the problem
};

std::vector<OrderChain> order_chains(const Protocol& protocol, int observer_number, std::uint64_t seed,
                                     RotationRule rule = RotationRule::crossed);

/// A limit's value in a block, and the key that says it; 0: no limit.
struct LimitSetting {
    int amount = 0;
    std::string key;
    bool is_dropped = false; ///< the schedule has one, but it would contradict the order that the block has
};
LimitSetting limit_in(const Protocol& protocol, int block, const Factor& factor, OrderLimit::Kind kind);

/// Factors that limits can be on: all but the block.
bool can_be_limited(const Factor& factor);

/// The key that limits a factor without naming it in a table, such as "max_object_run"; empty if there is
/// none.
std::string own_limit_key(std::string_view factor, OrderLimit::Kind kind);

} // namespace overt
