/// Table 1 of the paper: two levels of a factor compared within observers.
#pragma once

#include <vector>

#include "experiment/study/fixation_maps.h"
#include "experiment/study/read/study_reader.h"
#include "experiment/study/results/study_groups.h"
#include "experiment/study/results/study_options.h"

namespace overt {

/// A row for each pair of levels of the compared column, within each group of the other columns of `--by`
/// (objects together). Observers are compared with themselves on each object that they saw in both
/// levels, and their comparisons averaged. Beside each similarity:
///
/// - halves: of random halves of both levels, one of each, and of both halves of the same level. All are of
/// as
///   many fixations, half of what the level with fewer has, so that the two can be held against each other:
///   without a difference they are alike but for what fixations of one trial have in common, such as its
///   error of calibration, which makes those of the same level more alike;
/// - the null: of the same numbers of fixations drawn without regard to the level from both, and p, how often
///   that gives as small a mean similarity as was found.
///
/// That null takes fixations as independent. The test that does not compares the levels' maps over all
/// observers and swaps whole maps (swap_test).
///
/// Where there are several groups, rows over all of them follow: the comparisons are those within the groups,
/// so that what the groups tell apart cannot pass for a difference of levels.
///
/// Maps count fixations alike and are made on the coarse surface. Empty if no column of `--by` is compared.
std::vector<PairRow> study_pairs(const StudyResults& results, const std::vector<ObjectSurface>& surfaces,
                                 const ObjectFixationMaps& maps, const LevelLists& levels,
                                 const StudyOptions& options);

} // namespace overt
