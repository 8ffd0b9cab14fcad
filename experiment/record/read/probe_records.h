/// Probes, and what was set with gauges, as rows of their tables.
#pragma once

#include <vector>

#include "experiment/record/read/session_record.h"

namespace overt {

/// Gives the attempts their probes, their answers what was set with gauges, and their inputs how a gauge was
/// turned after each; sessions of earlier programs have none. Throws SQLite::Exception.
void add_probes(const SQLite::Database& database, std::vector<TrialRecord>& trials);

} // namespace overt
