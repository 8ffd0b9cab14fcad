/// What the tracker itself said besides samples, and fixations, saccades and blinks, as rows of a table.
#pragma once

#include <optional>
#include <string>

#include "experiment/record/read/session_record.h"
#include "experiment/record/tables/row_layout.h"

namespace overt {

struct GazeEventRow {
    const GazeEvent& event;
    int trial; ///< from 1; 0: outside of trials
    const std::optional<ClockMap>& clock_map;
    SessionRecord::EventOrigin::From origin; ///< of fixations, saccades and blinks
};

/// One row for each fixation, saccade, blink, message, button, input, begin and end of a recording, and note.
/// `origins`: whole sentences on where fixations, saccades and blinks come from.
RowLayout<GazeEventRow> gaze_events_layout(const std::string& origins);

/// Writes those of a trial. Throws RecordError.
void write_gaze_events(TableWriter& writer, const RowLayout<GazeEventRow>& layout,
                       const SessionRecord& record, const TrialRecord& trial);

/// The same of those outside of trials.
void write_gaze_events_outside(TableWriter& writer, const RowLayout<GazeEventRow>& layout,
                               const SessionRecord& record);

} // namespace overt
