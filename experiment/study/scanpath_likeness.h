/// Whether observers' ways of gaze over an object are more alike where they saw the same level of a factor.
#pragma once

#include <vector>

#include "experiment/study/scanpaths.h"

namespace overt {

/// ScanMatch with bins of this, and a threshold of twice the standard deviation of all steps on the object,
/// as its authors advise.
inline constexpr double scan_match_bin_s = 0.1;

/// ScanMatch and the five of MultiMatch (scanpath_measures.h), for each two levels of the compared column, in
/// each group of the other columns but the object, and over all groups. Compares each two observers who have
/// both levels on one object, all else alike: both in either level, and each level of one with the other of
/// the other, of which a row has the means over pairs of observers, with intervals by the jackknife
/// (PairwiseMean). Trials of an observer that are alike in everything are compared each with each.
std::vector<ScanpathLikenessRow> scanpath_likeness(const StudyResults& results,
                                                   const ObjectDistances& distances, const LevelLists& levels,
                                                   const StudyOptions& options);

} // namespace overt
