/// A sitting: the session's run through its trials, watched from outside.
#pragma once

#include "app/session/sitting_record.h"
#include "experiment/session/session.h"

namespace overt {

/// Runs the session from where the plan has it, into `record`, with the operator's view and the terminal's
/// progress beside it. `again`: null for a session that is recorded for the first time. Throws as
/// Session::run() does, with the trackers' own files saved.
SessionResult run_sitting(const Protocol& protocol, const RunOptions& options, const SessionPlan& plan,
                          SessionEquipment& equipment, SittingRecord& record, const PresentingAgain* again);

} // namespace overt
