/// Figure 5 of the paper: how fixations scatter.
#pragma once

#include <vector>

#include "experiment/study/read/study_reader.h"
#include "experiment/study/results/study_groups.h"
#include "experiment/study/results/study_options.h"

namespace overt {

/// One row for each group and each object of it. The fixations of all observers are pooled, as in the
/// paper; the interval of WSS is over observers, by pooling those drawn. After the maps are made, whose peaks
/// and means are taken over.
std::vector<DistributionRow> point_distributions(const StudyResults& results,
                                                 const std::vector<ObjectSurface>& surfaces,
                                                 const StudyOptions& options);

} // namespace overt
