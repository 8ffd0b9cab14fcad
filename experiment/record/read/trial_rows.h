/// Attempts at trials as rows of their table.
#pragma once

#include <string_view>
#include <vector>

#include "experiment/record/read/session_record.h"

namespace overt {

/// All attempts, in the order in which they were made; their trials' blocks are not among the columns. Throws
/// SQLite::Exception, and RecordError for times that are none.
std::vector<TrialRecord> read_trials(const SQLite::Database& database);

/// Its word in the record and in tables; empty: undecided.
std::string_view name_of(TrialOutcome::Afterwards afterwards);

} // namespace overt
