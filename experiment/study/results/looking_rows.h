/// What observers do with their gaze in the course of trials, and how two levels of a factor differ in it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiment/statistics/estimate.h"
#include "experiment/statistics/paired_evidence.h"
#include "experiment/study/results/study_key.h"

namespace overt {

/// Two levels of a factor compared within observers by what their trials come to: see measure_differences.h.
struct MeasureDifferenceRow {
    std::string measure; ///< as the tables of levels call it, "dwell_s"
    std::string of;      ///< an area, or two with " > " between; empty: the whole object
    std::string unit;    ///< "s"; empty: none
    std::string column, a, b;
    Estimate difference;             ///< of a less b: mean over observers
    std::optional<double> p, p_holm; ///< sign flips over observers; after Holm over the rows of the measure
    PairedEvidence evidence{};       ///< of the difference
    int observers = 0, comparisons = 0; ///< of an observer with one object, all else alike
};

/// A stretch of the presentation in which two levels differ in how much of the time goes to an area: see
/// time_clusters.h.
struct TimeClusterRow {
    std::string area, column, a, b;
    int number = 0; ///< the largest first; 0: there is none
    double from_s = 0.0, to_s = 0.0;
    double mass = 0.0; ///< sum of t over the stretch, times seconds
    double difference =
        0.0;        ///< share of the time on the area, of a less b: mean over the stretch and observers
    double p = 1.0; ///< corrected over the presentation
    double p_of_all = 1.0; ///< and over all rows of the table
    double threshold_t = 0.0;
    double least_p = 1.0; ///< that so many observers can give
    int observers = 0;
    std::string absent; ///< why there is no test
};

/// Whether a trial's first fixations go to an area.
struct FirstFixationsRow {
    std::string area;
    std::vector<StudyKey> keys;    ///< a level of a column; empty: all
    int number = 0;                ///< of the counted fixation, from 1
    Estimate at;                   ///< share of trials whose fixation of this number is on the area
    Estimate up_to;                ///< share of the fixations up to it, of a trial
    int observers = 0, trials = 0; ///< with a fixation of this number
};

/// How gaze goes over the surface: of trials the means over each observer's, then over observers. See
/// scanpaths.h.
struct ScanpathRow {
    std::vector<StudyKey> keys; ///< a group's, or a single one of these; empty: all
    Estimate fixations;         ///< of a trial
    Estimate fixation_s;        ///< duration of one
    Estimate step_mm, step_deg; ///< way along the surface from one fixation to the next
    Estimate way_mm;            ///< of a trial: the sum of these
    Estimate coverage;    ///< share of what is visible of the surface that is within a kernel's width of any
    Estimate entropy;     ///< of the map of a trial, as a share of that of an even one
    Estimate recurrence;  ///< share of pairs of fixations that are within a kernel's width of each other
    Estimate determinism; ///< share of these in runs of two and more successive ones
    Estimate
        return_distance; ///< mean number of fixations between the two of a pair, as a share of the trial's
    int observers = 0, trials = 0;
};

/// How alike the ways of gaze of two observers are: see scanpath_likeness.h.
struct ScanpathLikenessRow {
    std::string measure; ///< "scanmatch", or "multimatch_" and shape, length, direction, position, duration
    std::vector<StudyKey> keys; ///< what is the same in both levels; empty: all groups, compared within each
    std::string column, a, b;
    /// Of two observers who saw the same level, or different ones; the former less the latter.
    Estimate same_level, other_level, level_effect;
    Estimate shuffled; ///< of two who saw the same level, with the fixations of one in an order by chance
    int observers = 0;
};

} // namespace overt
