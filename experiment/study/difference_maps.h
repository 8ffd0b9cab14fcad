/// Where on the surface two levels of the compared column differ within observers.
#pragma once

#include <vector>

#include "experiment/study/fixation_maps.h"

namespace overt {

/// For each pair of levels, within each group of the other columns of `--by` and for all of these together,
/// on each object that some observer saw in both levels. Each observer gives one map of differences: the
/// share of the time of fixation per mm^2 in a less that in b. Where they differ from 0 is tested by clusters
/// (cluster_test.h), whose p is corrected for the whole surface; `p_of_all` for all maps of the study, too.
/// Clusters are of samples of the surface (FixationMaps); the map is given at every vertex of the mesh.
std::vector<DifferenceMap> difference_maps(const StudyResults& results, const ObjectFixationMaps& maps,
                                           const LevelLists& levels, const StudyOptions& options);

} // namespace overt
