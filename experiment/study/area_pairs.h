/// Whether two levels of a factor differ in how often each area is looked at.
#pragma once

#include <vector>

#include "experiment/study/read/study_reader.h"
#include "experiment/study/results/study_groups.h"
#include "experiment/study/results/study_options.h"

namespace overt {

/// For each of the compared areas the rows of table 1: within observers and objects, then means over an
/// observer's objects, then over observers.
std::vector<AreaPairRow> area_pairs(const StudyResults& results, const std::vector<ObjectSurface>& surfaces,
                                    const LevelLists& levels, const StudyOptions& options);

} // namespace overt
