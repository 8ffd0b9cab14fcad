/// The ledger of a trial as rows of the flips.
#pragma once

#include <cstdint>
#include <optional>

#include "experiment/record/read/session_record.h"
#include "experiment/record/tables/shared_columns.h"

namespace overt {

/// A refresh of a presentation, flipped or missed.
struct LedgerRow {
    int trial; ///< from 1
    int slot;  ///< of the session
    int refresh;
    const FlipReport* flipped; ///< as it was recorded; null: missed
    AnimationFrameIndex planned;
    const FlipRecord& lit; ///< the flip whose frame was lit, at the times of the line
    MappedTime onset;
    int missed_before;
    std::optional<MissCause> cause;
    int motion = 0; ///< of the session
};

/// `header` must outlive it.
RowLayout<LedgerRow> ledger_layout(const SharedColumns& shared, const SessionHeader& header);

/// Writes a row for each refresh of a trial, as the presentation in its slot has it, flipped or missed, in
/// their order; gives the number of flips. Throws RecordError.
std::int64_t write_ledger(TableWriter& writer, const RowLayout<LedgerRow>& layout,
                          const SessionHeader& header, const TrialRecord& trial,
                          const std::optional<TrialLedger>& ledger);

} // namespace overt
