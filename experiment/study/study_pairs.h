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
/// - of maps of two observers who saw the same level, and of two who saw different ones, all of as many
///   fixations of either level (observer_similarities.h): without a difference both are the same;
/// - the null: whole trials of an observer on an object, dealt out again over both levels, and p, how often
///   that gives as small a mean similarity as was found. Takes an observer's trials as exchangeable, and not
///   the fixations of a trial, which share its error of calibration.
///
/// Of one trial of each level there is no null. The test that needs none compares the levels' maps over all
/// observers and swaps whole maps (swap_test).
///
/// Where there are several groups, rows over all of them follow: the comparisons are those within the groups,
/// so that what the groups tell apart cannot pass for a difference of levels.
///
/// Maps count fixations alike, and what no frame shows is no part of them. Empty if no column of `--by` is
/// compared.
std::vector<PairRow> study_pairs(const StudyResults& results, const std::vector<ObjectSurface>& surfaces,
                                 const ObjectFixationMaps& maps, const LevelLists& levels,
                                 const StudyOptions& options);

} // namespace overt
