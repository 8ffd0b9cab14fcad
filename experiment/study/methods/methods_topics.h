/// The topics of the text on methods, one file each. Each function gives whole sentences, or nothing.
#pragma once

#include <string>

#include "experiment/study/results/study_options.h"
#include "experiment/study/results/study_results.h"

namespace overt {

/// Who took part, which trials there are, and which were excluded by which rules.
std::string observers_text(const StudyResults& results, const ExclusionRules& rules);
/// The display and the eye tracker.
std::string apparatus_text(const StudyResults& results);
/// What was shown and asked.
std::string stimuli_text(const StudyResults& results);
/// Calibration, accuracy, precision, losses, missed refreshes.
std::string gaze_quality_text(const StudyResults& results);
/// Whose fixations, saccades and blinks these are.
std::string events_text(const StudyResults& results);
/// From samples to places on the surface, and which fixations count.
std::string places_text(const StudyResults& results, const StudyOptions& options);
/// Areas of the screen, and what gaze did with them.
std::string screen_areas_text(const StudyResults& results, const StudyOptions& options);
/// What was answered, and how it was analysed; empty without answers.
std::string answers_text(const StudyResults& results, const StudyOptions& options);
/// Maps, comparisons, tests and intervals.
std::string statistics_text(const StudyResults& results, const StudyOptions& options);

} // namespace overt
