/// What the observer moved, as tables: settings of matches, what each flip contained, how objects were
/// turned.
#pragma once

#include "experiment/record/read/observer_turns.h"
#include "experiment/record/read/session_record.h"
#include "experiment/record/tables/shared_columns.h"

namespace overt {

/// One column of a match in an attempt that ended, given or missed.
struct SettingRow {
    const TrialRecord& attempt;
    const GivenAnswer& given;
    const MatchSetting& set;
    operator const TrialRecord&() const { return attempt; }
};
/// `header` must outlive it, as of all.
RowLayout<SettingRow> settings_layout(const SharedColumns& shared, const SessionHeader& header);

/// A flip of a presentation that the observer moves.
struct MoveRow {
    const TrialRecord& seen; ///< TrialRecord::seen_in
    const SteeredFlip& moved;
    const FlipRecord& lit;   ///< at the times of the line
    const MatchLevel* level; ///< null: the slot is no match's
    operator const TrialRecord&() const { return seen; }
};
RowLayout<MoveRow> moves_layout(const SharedColumns& shared, const SessionHeader& header);

/// A show of an object that the observer turned.
struct TurnRow {
    const TrialRecord& seen;
    const ObserverTurns& turns;
    operator const TrialRecord&() const { return seen; }
};
RowLayout<TurnRow> turns_layout(const SharedColumns& shared, const SessionHeader& header);

/// A pose that was lit of an object that the observer turned.
struct CourseRow {
    const TrialRecord& seen;
    int step = 0;     ///< as ObserverTurns has it
    double t_s = 0.0; ///< since the show's onset, in refreshes of the protocol's rate
    const ObjectPose& pose;
    operator const TrialRecord&() const { return seen; }
};
RowLayout<CourseRow> courses_layout(const SharedColumns& shared, const SessionHeader& header);

/// Writes a row for each pose of a presentation that differs from the one before, and one for the end of each
/// show. Throws RecordError.
void write_courses(TableWriter& writer, const RowLayout<CourseRow>& layout, const SessionRecord& record,
                   const TrialRecord& seen, const std::optional<TrialLedger>& ledger);

/// Writes the rows of a presentation; gives how many. Throws RecordError.
std::int64_t write_moves(TableWriter& writer, const RowLayout<MoveRow>& layout, const SessionRecord& record,
                         const TrialRecord& seen, const std::optional<TrialLedger>& ledger);

} // namespace overt
