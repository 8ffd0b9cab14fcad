/// How a recorded session was set up.
#pragma once

#include "experiment/record/read/session_record.h"
#include "experiment/study/results/session_setup.h"

namespace overt {

/// What the record says of its tracker, its display and its stimuli.
SessionSetup setup_of(const SessionRecord& record);

} // namespace overt
