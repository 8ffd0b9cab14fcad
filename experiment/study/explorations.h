/// How observers turned objects, over shows and observers.
#pragma once

#include "experiment/statistics/bootstrap.h"
#include "experiment/study/results/exploration_rows.h"

namespace overt {

/// Fills the summaries: of each observer and of all, over all shows and for each level of each column that
/// has several. The share of the time in which it turned is the sum of those times over the sum of the
/// shows'; the speed is the path over the time of turning, absent where nothing turned. Intervals: of one
/// observer over shows, of all over observers.
void reckon_explorations(StudyExplorations& explorations, const BootstrapSettings& bootstrap);

} // namespace overt
