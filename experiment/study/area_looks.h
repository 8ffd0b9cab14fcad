/// How long and how often gaze is on an area, and when it first comes there.
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "experiment/statistics/bootstrap.h"
#include "experiment/study/results/study_results.h"

namespace overt {

/// What one trial's counted fixations do with an area.
struct SurfaceAreaLook {
    double dwell_s = 0.0; ///< time of fixation on it
    /// Runs of successive fixations on it: one elsewhere, or beside the object, ends a run. Fixations that
    /// are too short, or under way at the onset, neither end a run nor belong to it.
    int visits = 0;
    std::optional<double> first_arrival_s; ///< onset of the first fixation on it; nothing: never
    int first_arrival_number = 0;          ///< of that fixation among the counted ones, from 1
};

/// Nothing if the trial's object does not have the area.
std::optional<SurfaceAreaLook> area_look(const StudyResults& results, const StudyTrial& trial,
                                         std::string_view area);

/// Sets the measures of trials in a row: of each observer's trials, which are one list, the means, then over
/// observers.
void add_looks(AreaRow& row, const StudyResults& results,
               std::span<const std::vector<int>> trials_of_observers, const BootstrapSettings& bootstrap);

} // namespace overt
