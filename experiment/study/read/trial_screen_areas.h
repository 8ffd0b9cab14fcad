/// The areas of the screen that a trial has: by messages of an imported recording, and by a file.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "experiment/record/read/session_record.h"
#include "experiment/screen_areas/screen_areas_file.h"
#include "experiment/study/results/study_results.h"

namespace overt {

/// What messages "!V IAREA" of a trial say; messages without times hold all the trial, whenever they came.
struct RecordedScreenAreas {
    std::vector<ScreenArea> areas;
    std::vector<std::string> faults; ///< clauses, each of a message that cannot be read
    std::vector<std::string> files;  ///< that messages name; they are not opened
};

/// Of a trial whose gaze was imported; nothing of others.
RecordedScreenAreas recorded_screen_areas(const SessionRecord& record, const TrialRecord& trial);

/// Those of a file that are of a trial with these keys.
std::vector<ScreenArea> chosen_screen_areas(std::span<const ChosenScreenArea> chosen,
                                            const StudyTrial& trial);

/// The columns that a file's areas ask for and that no trial has, each once.
std::vector<std::string> unknown_columns(std::span<const ChosenScreenArea> chosen,
                                         const StudyResults& results);

} // namespace overt
