/// Where on the surface two levels of the compared column differ within observers.
#pragma once

#include <vector>

#include "experiment/study/fixation_maps.h"

namespace overt {

/// An observer's fixations on an object in two conditions; neither empty.
struct ComparedFixations {
    Fixations a, b;
};

/// Fills in what `of` says of the difference of these observers, one at least: each one's share of the time
/// of fixation per mm^2 in a less that in b, and its clusters. With one observer it is absent for the reason.
void find_difference(DifferenceMap& of, const std::vector<ComparedFixations>& observers,
                     const FixationMaps& maps, const StudyOptions& options, const std::string& of_one);

/// Sets `p_of_all` of all clusters: corrected over the maps that have been tested.
void correct_over_maps(std::vector<DifferenceMap>& maps);

/// For each pair of levels, within each group of the other columns of `--by` and for all of these together,
/// on each object that some observer saw in both levels. Each observer gives one map of differences: the
/// share of the time of fixation per mm^2 in a less that in b. Where they differ from 0 is tested by clusters
/// (cluster_test.h), whose p is corrected for the whole surface; `p_of_all` for all maps of the study, too.
/// Clusters are of samples of the surface (FixationMaps); the map is given at every vertex of the mesh.
std::vector<DifferenceMap> difference_maps(const StudyResults& results, const ObjectFixationMaps& maps,
                                           const LevelLists& levels, const StudyOptions& options);

} // namespace overt
