/// What gaze did with areas of the screen, in each trial and over groups of trials.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiment/screen_areas/screen_area.h"
#include "experiment/statistics/area_visits.h"
#include "experiment/statistics/estimate.h"
#include "experiment/study/results/study_key.h"

namespace overt {

/// Name of what fixations that lie in no area are in.
inline constexpr const char* no_screen_area = "(none)";

/// One area in one trial that is not excluded.
struct ScreenAreaTrialRow {
    int trial = 0; ///< index into StudyResults::trials
    std::string area;
    double there_s = 0.0; ///< how long of the presentation it was there
    /// Share of fixation time that gaze spread evenly over the screen and the presentation would have in it;
    /// nothing of recordings whose screen or duration is not known.
    std::optional<double> share_by_chance;
    std::optional<double> dwell_share; ///< of the trial's time of fixation; nothing: it has no fixations
    AreaVisits visits;
};

/// How often gaze went from one area straight to another in a trial; only ways that were taken.
struct AreaTransitionRow {
    int trial = 0;
    std::string from, to;
    int count = 0;
};

/// An area over the trials of a group that have it: means over observers of their own means.
struct ScreenAreaRow {
    std::vector<StudyKey> keys; ///< a group's, or a single one of these: all trials with it; empty: all
    std::string area;
    std::optional<double> share_by_chance; ///< mean over trials
    Estimate dwell_share;                  ///< of an observer: all dwell time of all time of fixation
    Estimate visits;                       ///< of a trial
    Estimate reached;                      ///< share of trials with a fixation in it
    Estimate first_arrival_s;              ///< of trials with one
    int observers = 0, trials = 0, fixations = 0;
};

} // namespace overt
