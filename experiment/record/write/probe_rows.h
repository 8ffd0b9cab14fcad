/// Rows of probes, and of what was set with gauges, of an attempt that ended.
#pragma once

#include <cstdint>

#include "experiment/ports/trial_outcome.h"

namespace SQLite {
class Database;
}

namespace overt {

/// Throws SQLite::Exception.
void write_probe_rows(SQLite::Database& database, std::int64_t trial_id, const TrialOutcome& outcome);

} // namespace overt
