/// The ledger of a trial as rows of the flips.
#pragma once

#include <cstdint>

#include "experiment/record/read/session_record.h"
#include "experiment/record/tables/table_writer.h"

namespace overt {

/// Writes a row for each refresh of a trial, flipped or missed, in their order; gives the number of flips.
/// Columns as ExportTables::flips has them. Throws RecordError.
std::int64_t write_ledger(TableWriter& writer, const SessionHeader& header, const TrialRecord& trial,
                          const std::optional<TrialLedger>& ledger);

} // namespace overt
