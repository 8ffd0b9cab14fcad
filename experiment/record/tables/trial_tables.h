/// Attempts at trials, and their answers, as tables.
#pragma once

#include "experiment/record/read/session_record.h"
#include "experiment/record/tables/sample_rows.h"
#include "experiment/record/tables/shared_columns.h"

namespace overt {

struct TrialRow {
    const TrialRecord& trial;
    const SampleCounts* samples; ///< null: of an attempt that does not count
    operator const TrialRecord&() const { return trial; }
};

/// `header` must outlive it, as the next.
RowLayout<TrialRow> trials_layout(const SharedColumns& shared, const SessionHeader& header);
/// With the same columns and the slot: of presentations (TrialRecord::seen_in).
RowLayout<TrialRow> presentations_layout(const SharedColumns& shared, const SessionHeader& header);

/// Of attempts that count.
RowLayout<TrialRecord> responses_layout(const SharedColumns& shared, const SessionHeader& header);

} // namespace overt
