/// The files of a table export and what stands in each column: their first lines and their dictionary both
/// come from here, whatever their format.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "experiment/record/session_header.h"
#include "experiment/record/tables/gaze_event_rows.h"
#include "experiment/record/tables/ledger_rows.h"
#include "experiment/record/tables/participant_rows.h"
#include "experiment/record/tables/probe_tables.h"
#include "experiment/record/tables/session_tables.h"
#include "experiment/record/tables/steered_tables.h"
#include "experiment/record/tables/trial_tables.h"
#include "experiment/units.h"

namespace overt {

/// All tables of one session's export. Levels name the session's own tasks, objects and materials.
class ExportTables {
  public:
    /// `pupil`: what the tracker calls the size of a pupil. `further`: of the samples. `event_origins`: see
    /// gaze_events_layout(). `participant` is the session's. All tables begin with the observer and the
    /// number of the session, so that those of several sessions can be put one below the other. `header` must
    /// outlive it.
    explicit ExportTables(const SessionHeader& header,
                          const PupilWords& pupil = pupil_words(PupilMeasure::unknown),
                          const FurtherColumns& further = {}, const std::string& event_origins = {},
                          const std::vector<ParticipantRow>& participant = {})
        : ExportTables(header, SharedColumns(header), pupil, further, event_origins, participant) {}

    RowLayout<TrialRow> trials;
    RowLayout<TrialRow> presentations; ///< of sessions with several slots
    RowLayout<LedgerRow> flips;
    RowLayout<SampleCells> samples;
    RowLayout<GazeEventRow> gaze_events;
    RowLayout<RecordedEvent> events;
    RowLayout<TrialRecord> responses;
    RowLayout<RecordedStimulus> stimuli;
    RowLayout<DisplayBoxRow> display_box;
    RowLayout<RecordedButton> buttons;
    RowLayout<RecordedKeyPress> key_presses;
    RowLayout<RecordedMarker> markers;
    RowLayout<StepRow> steps;
    RowLayout<GivenAnswerRow> given_answers;
    RowLayout<AnswerInputRow> answer_inputs;
    // Of sessions whose protocols name places on surfaces.
    RowLayout<RecordedPoint> points;
    RowLayout<ProbeRow> probes;
    RowLayout<GaugeRow> gauges;
    RowLayout<GaugeChangeRow> gauge_changes;
    // What the observer moved.
    RowLayout<SettingRow> settings;
    RowLayout<MoveRow> moves;
    RowLayout<TurnRow> turns;
    RowLayout<CourseRow> courses;
    RowLayout<ParticipantRow> participants;

    std::vector<const Table*> all() const;

  private:
    bool has_slots_, has_points_;
    ExportTables(const SessionHeader& header, const SharedColumns& shared, const PupilWords& pupil,
                 const FurtherColumns& further, const std::string& event_origins,
                 const std::vector<ParticipantRow>& participant);
};

/// Of each column Description, Units and Levels, as in BIDS side cars.
nlohmann::ordered_json describe_columns(const std::vector<TableColumn>& columns, TableFormat format);

/// Adds the table's file to a dictionary: its description, and its columns by describe_columns(), with the
/// Format of each ("string", "integer", "number") where all its cells have one.
void describe_table(nlohmann::ordered_json& dictionary, const Table& table, TableFormat format);

/// The dictionary as JSON: each of the files.
std::string table_dictionary(const ExportTables& tables, TableFormat format);

} // namespace overt
