/// Fixations, saccades and blinks that the program found, found again in the recorded samples.
#pragma once

#include "app/replay/replay_report.h"
#include "experiment/events/event_settings.h"
#include "experiment/record/read/session_record.h"

namespace overt {

/// Adds to the report the first that differs. Where they are the tracker's own, or another version's of the
/// method, the report says that they were not compared.
void compare_found_events(const SessionRecord& record, const EventSettings& settings, ReplayReport& report);

} // namespace overt
