/// How well maps would come out again with other observers.
#pragma once

#include <vector>

#include "experiment/study/fixation_maps.h"

namespace overt {

/// Rows for each group, for each level of each column of `--by`, and for all trials, on each object: how well
/// the maps of the observers (fixations count alike) agree over the places that could be seen
/// (map_agreement.h).
std::vector<MapReliabilityRow> map_reliabilities(const StudyResults& results, const ObjectFixationMaps& maps,
                                                 const LevelLists& levels, const StudyOptions& options);

} // namespace overt
