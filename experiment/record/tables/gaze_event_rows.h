/// What the tracker itself said besides samples, as rows of a table.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiment/record/read/session_record.h"
#include "experiment/record/tables/row_layout.h"

namespace overt {

/// A row that is of an event of the tracker's.
struct TrackerEventRow {
    const GazeEvent& event;
};

/// Its places, pupil, size and speed; the same in each kind of export, but for the words of its units.
/// `pupil`: see pupil_words().
std::vector<RowLayout<TrackerEventRow>::Column>
event_value_columns(const std::string& pixels, const std::string& of_pupil, const std::string& pupil = {});

struct GazeEventRow : TrackerEventRow {
    int trial; ///< from 1; 0: outside of trials
    const std::optional<ClockMap>& clock_map;
    SessionRecord::EventOrigin::From origin; ///< of fixations, saccades and blinks
};

/// One row for each fixation, saccade, blink, message, button, input, begin and end of a recording, and note.
/// `origins`: whole sentences on where fixations, saccades and blinks come from.
RowLayout<GazeEventRow> gaze_events_layout(const std::string& origins, const std::string& pupil);

/// Writes those of a trial. Throws RecordError.
void write_gaze_events(TableWriter& writer, const RowLayout<GazeEventRow>& layout,
                       const SessionRecord& record, const TrialRecord& trial);

/// The same of those outside of trials.
void write_gaze_events_outside(TableWriter& writer, const RowLayout<GazeEventRow>& layout,
                               const SessionRecord& record);

} // namespace overt
