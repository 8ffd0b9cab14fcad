/// What a session's column of pupils holds, in words for dictionaries.
#pragma once

#include <string>

#include "experiment/record/read/session_record.h"

namespace overt {

/// "Pupil area" or "Pupil diameter"; where the recordings of an imported file differ, also the trials in
/// which pupils are diameters. Throws RecordError.
std::string pupil_words(const SessionRecord& record);

} // namespace overt
