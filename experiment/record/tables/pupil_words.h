/// What a session's column of pupils holds, in words for dictionaries.
#pragma once

#include <string>

#include "experiment/record/read/session_record.h"

namespace overt {

/// What a column of pupils is called, means, and is counted in.
struct PupilWords {
    std::string column =
        "pupil_area"; ///< pupil_area, pupil_diameter, or pupil_size where it is not one of these
    std::string meaning = "Pupil area";
    std::string unit = "the tracker's own unit"; ///< or mm
};

/// By the tracker, and of an imported recording by what it says of itself. Where the recordings of a session
/// differ, the meaning names the trials in which pupils are diameters. Throws RecordError.
PupilWords pupil_words(const SessionRecord& record);

} // namespace overt
