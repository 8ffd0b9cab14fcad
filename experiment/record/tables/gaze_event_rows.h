/// What the tracker itself said besides samples, as rows of a table.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiment/record/read/session_record.h"
#include "experiment/record/read/tracker_facts.h"
#include "experiment/record/tables/joined_cells.h"
#include "experiment/record/tables/row_layout.h"
#include "experiment/study/results/study_results.h"

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
    /// Where a fixation of the trial met the surface; empty of all else, and beside the presentation.
    std::optional<StudyFixation> fixation = {};
    std::span<const std::string> part_cells = {}; ///< of the trial's object: part_cells_of()
    std::string_view slot = {};                   ///< of a fixation that lies in one
};

/// One row for each fixation, saccade, blink, message, button, input, begin and end of a recording, and note.
/// `origins`: whole sentences on where fixations, saccades and blinks come from. `header` must outlive it.
RowLayout<GazeEventRow> gaze_events_layout(const SessionHeader& header, const std::string& origins,
                                           const PupilWords& pupil);

/// Writes those of a trial as the presentation in its slot has them, `events` with where they met the
/// surface, `fixations`. Throws RecordError.
void write_gaze_events(TableWriter& writer, const RowLayout<GazeEventRow>& layout,
                       const SessionRecord& record, const TrialRecord& trial,
                       std::span<const GazeEvent> events,
                       std::span<const std::optional<StudyFixation>> fixations);

/// The same of those outside of trials, which have no places.
void write_gaze_events_outside(TableWriter& writer, const RowLayout<GazeEventRow>& layout,
                               const SessionRecord& record);

} // namespace overt
