/// Where on the surface two levels of the compared column differ within observers.
#pragma once

#include <string>
#include <vector>

#include "experiment/study/fixation_maps.h"

namespace overt {

/// An observer's fixations on an object in two conditions; neither empty.
struct ComparedFixations {
    std::string observer;
    Fixations a, b;
};

/// A map of differences that is still to be reckoned.
struct ComparedLevels {
    DifferenceMap map;                        ///< what is compared, and on which object
    std::vector<ComparedFixations> observers; ///< one at least
};

/// Reckons all maps of one table: each observer's share of the time of fixation per mm^2 in a less that in
/// b, and clusters of differences. Signs of observers are flipped in all maps at once, and `p_of_all` is that
/// of the largest cluster of all maps. With one observer a map is absent for the reason `of_one`.
std::vector<DifferenceMap> find_differences(std::vector<ComparedLevels> compared,
                                            const ObjectFixationMaps& maps, const StudyOptions& options,
                                            const std::string& of_one);

/// For each pair of levels, within each group of the other columns of `--by` and for all of these together,
/// on each object that some observer saw in both levels. Each observer gives one map of differences: the
/// share of the time of fixation per mm^2 in a less that in b. Where they differ from 0 is tested by clusters
/// (cluster_test.h), whose p is corrected for the whole surface; `p_of_all` for all maps of the study, too.
/// Clusters are of samples of the surface (FixationMaps); the map is given at every vertex of the mesh.
std::vector<DifferenceMap> difference_maps(const StudyResults& results, const ObjectFixationMaps& maps,
                                           const LevelLists& levels, const StudyOptions& options);

} // namespace overt
