/// The places of its probes that each trial of a task has.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "experiment/protocol/protocol.h"
#include "experiment/trial.h"

namespace overt {

/// A list by its id; null if there is none.
const PointListSettings* point_list(const Protocol& protocol, std::string_view id);

/// In how many ways a task's probes have places: each set of different places once of probes that share a
/// list, and all of those with all of other lists. Without what draw_points leaves out; capped at `at_most`.
std::size_t point_combinations(const Protocol& protocol, const Task& task, std::size_t at_most);

/// The same trials, each with all combinations of places, or with those that are drawn: levels of its own by
/// the probes' ids. Which of a set stands at which probe is drawn. Where a rule keeps the order of its
/// trials, or a procedure chooses their levels, each has one combination, all of them in turn. Probes of
/// which a table has a column keep what it says; so do trials without any.
std::vector<Trial> with_points(const Protocol& protocol, std::vector<Trial> trials, int task, int block,
                               int observer_number, std::uint64_t seed);

/// The first place of each probe, for a trial of practice.
std::vector<TrialLevel> first_points(const Protocol& protocol, int task);

} // namespace overt
