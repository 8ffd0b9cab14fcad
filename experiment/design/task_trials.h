/// The trials of a task that has a rule or a table of its own, for one observer.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "experiment/design/block_plan.h"
#include "experiment/protocol/protocol.h"
#include "experiment/trial.h"

namespace overt {

/// What a rule is asked for in a block: its stimuli, with the levels of the factors that the protocol names.
/// Names that are no factor are left out, and are in `unknown`.
struct RuleTask {
    RuleRequest request;
    std::vector<Stimulus> stimuli;    ///< by their number in the request
    std::vector<int> slots;           ///< of the task, as indices
    std::vector<std::string> unknown; ///< names that are no factors
    std::vector<std::string> unsaid;  ///< lists of several entries of which nothing says what is shown
};

/// `stimuli`: what the block can show.
RuleTask rule_task(const Protocol& protocol, int task, const std::vector<Stimulus>& stimuli);

/// Lists, and columns of their entries: what can be said of a stimulus.
std::vector<std::string_view> stimulus_factor_names(const Factors& factors);

/// A factor's levels of these stimuli; nothing where there is no factor of this name.
std::optional<RuleFactor> stimulus_factor(const Factors& factors, const std::vector<Stimulus>& stimuli,
                                          std::string_view name);

/// The trials, each as often as it comes, of an observer in a block that shows these stimuli. The task must
/// have a rule or a table, and be sound. `seed` is the session's.
std::vector<Trial> own_trials(const Protocol& protocol, int task, int block,
                              const std::vector<Stimulus>& stimuli, int observer_number, std::uint64_t seed);

/// The trials that check the observer in a block, besides the task's among `trials`; none where it has none.
std::vector<Trial> catch_trials(const Protocol& protocol, int task, int block,
                                const std::vector<Stimulus>& stimuli, const std::vector<Trial>& trials,
                                int observer_number, std::uint64_t seed);

/// Whether two sessions of an observer can have different trials, by what is drawn.
bool draws_trials(const Protocol& protocol);

} // namespace overt
