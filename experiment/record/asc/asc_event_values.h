/// What stands at the end of a fixation's or a saccade's line in an ASC file.
#pragma once

#include <string_view>

#include "experiment/gaze_event.h"
#include "experiment/record/asc/asc_conventions.h"

namespace overt {

struct AscEventValues {
    bool is_whole = false; ///< else the line ends too early
    bool is_gaze = true;   ///< else its places are in the head's frame, and were left out
    int unreadable = 0;    ///< values that are neither numbers nor missing, and were left out
};

/// Reads place, pupil, size and speed into an event of its kind, from the words after its duration. Where
/// places are not in gaze coordinates (EVENTS HREF), the same values in these may follow, and are taken. What
/// is missing stays away: values of the file's missing number, the size of a saccade whose begin or end is
/// not known.
AscEventValues read_event_values(std::string_view words, bool are_gaze, const AscConventions& conventions,
                                 GazeEvent& event);

} // namespace overt
