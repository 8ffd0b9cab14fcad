/// What simulated observers mean to look at, beside what an analysis of their sessions found.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "app/inputs/protocol_inputs.h"
#include "experiment/study/results/study_results.h"

namespace overt {

/// Seeds of simulated observers by their labels.
using ObserverSeeds = std::map<std::string, std::uint64_t>;

/// Sets DistributionRow::planted_wss_mm2: the WSS of the places that the observers of these seeds mean to
/// look at in the row's trials, each presented twenty times. And AreaRow::planted: the
/// mean over the row's observers, and each one's trials with an object that has the area, of the share of
/// fixations that the observer of this seed means for the area (gaze_plan). And AreaRow::drawn: the mean over
/// the observers of the share of places that each one's scripts of these very trials have on the area, of
/// fixations that begin while the object is shown; nothing if a trial shows several things, or if answers
/// guide the gaze. Rows with an observer who has no seed stay without, and those of areas that have no share
/// of their own in the protocol.
void add_planted_truth(StudyResults& results, const Experiment& experiment, const ObserverSeeds& seeds);

} // namespace overt
