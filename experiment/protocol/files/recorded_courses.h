/// Tables of how objects were turned: from a file to the courses that trials show again.
#pragma once

#include <string>

#include "experiment/keys/delimited_text.h"
#include "experiment/protocol/protocol.h"

namespace overt {

/// Adds the courses of a table to a motion of kind "recorded", and their poses to its frames. What is wrong
/// with the table goes to `diagnostics` under `file`, all of it; then nothing is added. The columns: trial,
/// slot, t_s and angle_deg; those that may be missing are observer (then the file's name without its ending),
/// session (then 1), elevation_deg (then 0) and the lists that stimuli are made of. Others are passed over. A
/// row at t_s = 0 begins a show; until the next one times rise, and a pose stands until the next row. The
/// last row's time is the show's end.
void add_courses(const DelimitedText& table, MotionSettings& motion, const std::string& file,
                 Diagnostics& diagnostics);

} // namespace overt
