/// The ledger of a trial as rows of flips.tsv.
#pragma once

#include <cstdint>

#include "experiment/record/session_record.h"
#include "experiment/record/tsv_writer.h"

namespace overt {

/// Writes a row for each refresh of a trial, flipped or missed, in their order; gives the number of flips.
/// Columns as TsvTables::flips has them. Throws RecordError.
std::int64_t write_ledger(TsvWriter& writer, const SessionRecord& record, const TrialRecord& trial);

} // namespace overt
