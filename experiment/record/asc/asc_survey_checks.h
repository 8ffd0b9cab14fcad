/// What a surveyed recording must be to be imported.
#pragma once

#include <string>

#include "experiment/record/asc/asc_survey.h"

namespace overt {

/// Throws InputError naming the file and what helps if its samples are raw data of the tracker, or in the
/// head's frame, and no gaze on a screen.
void check_gaze(const AscSurvey& survey, const std::string& file, const AscSurveyOptions& options);

/// Throws InputError if a smaller share than `least` of the lines of samples, or of those of events, could be
/// read: of all recordings together, and of each that has more than a few lines.
void check_shares(const AscSurvey& survey, const std::string& file, double least);

} // namespace overt
