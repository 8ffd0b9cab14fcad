/// Two levels of a factor compared within observers by anything that their trials come to.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "experiment/study/results/study_groups.h"
#include "experiment/study/results/study_options.h"

namespace overt {

/// What trials give to a measure: sums, whose quotient is the measure of any number of trials together. A
/// mean over trials has a weight of 1 for each.
struct MeasureSums {
    double sum = 0.0, weight = 0.0;
    double least_weight = 0.0; ///< with no more than this the quotient tells nothing

    void add(const MeasureSums& of) {
        sum += of.sum;
        weight += of.weight;
        least_weight += of.least_weight;
    }
    bool tells() const { return weight > least_weight; }
};

/// A number that each trial has, or some have.
struct MeasureOfTrials {
    std::string name; ///< as the table of levels calls it, "dwell_s"
    std::string of;   ///< as MeasureDifferenceRow has it
    std::string unit;
    std::function<MeasureSums(int trial)> sums; ///< of a trial of the results; nothing: no weight
};

/// Dwell, visits, first arrival of each area (area_looks.h), transitions between areas
/// (surface_transitions.h), gain of gaze (gaze_motion.h) and light at gaze (light_at_gaze.h), of which there
/// are any. `results` must outlive them.
std::vector<MeasureOfTrials> looking_measures(const StudyResults& results);

/// Of each measure one row for each two levels of the compared column. An observer's trials on one object
/// that are alike in all other columns of `--by` are one measure in each level; the differences are averaged
/// over these, as far as both levels have one, and then over observers. p is that of flips of the signs of
/// observers' differences, corrected after Holm over the rows of the measure. Measures that no observer has
/// in two levels are left out.
std::vector<MeasureDifferenceRow> measure_differences(const StudyResults& results,
                                                      const std::vector<MeasureOfTrials>& measures,
                                                      const LevelLists& levels, const StudyOptions& options);

} // namespace overt
