/// How often each stimulus is shown over the planned observers, and where that is uneven.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "experiment/checks/design_report.h"
#include "experiment/design/schedule.h"

namespace overt {

/// Counted over the planned observers.
struct Presentations {
    std::vector<IncidenceCell> cells; ///< task by task, object by object, material by material
    /// The same cells for one block and one group (-1 without groups): how often each is shown there; -1 for
    /// what the block does not show to them at all.
    using Part = std::vector<int>;
    std::map<std::pair<int, int>, Part> parts; ///< by block and group
};

/// `seed` decides what comes in blocks that are drawn with replacement. Throws InputError as make_schedule.
Presentations count_presentations(const Protocol& protocol, ScheduleMaker& maker, std::uint64_t seed);

/// A sentence for each task some of whose stimuli are shown more often than others though nothing in the
/// protocol says so: weights are meant to, and what one block or group shows is not compared with what
/// another does.
std::vector<std::string> balance_warnings(const Protocol& protocol, const Presentations& presentations);

/// Factors that always change together, so that no analysis can part them.
std::vector<std::string> aliased_factor_warnings(const Factors& factors, const Presentations& presentations);

} // namespace overt
