/// How gaze goes over the surface in a trial.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "experiment/study/fixation_maps.h"
#include "experiment/study/measure_differences.h"
#include "experiment/study/results/study_groups.h"
#include "experiment/study/surface_distances.h"

namespace overt {

/// By object; null where there can be none.
using ObjectDistances = std::vector<std::unique_ptr<SurfaceDistances>>;
ObjectDistances surface_distances(const StudyResults& results, const std::vector<ObjectSurface>& surfaces);

/// Of a trial's counted fixations with a place: see ScanpathRow.
struct TrialScanpath {
    int fixations = 0;
    std::optional<double> fixation_s, step_mm, step_deg, way_mm, coverage, entropy, recurrence, determinism,
        return_distance;
};

/// By trial; without fixations, or without a surface, only their number. Two fixations are near each other,
/// and a place is covered, if the way between is no longer than the standard deviation of the maps' kernel,
/// mean of the trial's.
std::vector<TrialScanpath> trial_scanpaths(const StudyResults& results, const ObjectDistances& distances,
                                           const ObjectFixationMaps& maps);

/// For each group, each level of each column, and all trials.
std::vector<ScanpathRow> scanpath_rows(const StudyResults& results,
                                       const std::vector<TrialScanpath>& scanpaths, const LevelLists& levels,
                                       const StudyOptions& options);

/// The same numbers to be compared between levels. `scanpaths` must outlive them.
std::vector<MeasureOfTrials> scanpath_measures(const std::vector<TrialScanpath>& scanpaths);

} // namespace overt
