/// What the tracker itself said besides samples, as rows of a table.
#pragma once

#include "experiment/record/read/session_record.h"
#include "experiment/record/tables/table_writer.h"

namespace overt {

/// One row for each fixation, saccade, blink, message, button, input, begin and end of a recording, and note.
Table gaze_events_table();

/// Writes those of a trial. Columns as gaze_events_table() has them. Throws RecordError.
void write_gaze_events(TableWriter& writer, const SessionRecord& record, const TrialRecord& trial);

/// The same of those outside of trials.
void write_gaze_events_outside(TableWriter& writer, const SessionRecord& record);

} // namespace overt
