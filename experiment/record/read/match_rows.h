/// What was set in matches, as rows of their tables.
#pragma once

#include <vector>

#include "experiment/record/read/session_record.h"

namespace overt {

/// Gives the answers of these attempts their settings and levels; sessions of earlier programs have none.
/// Throws SQLite::Exception.
void add_matches(const SQLite::Database& database, std::vector<TrialRecord>& trials);

/// What the observer had moved the slot of a presentation to, by the number of the refresh. The same.
std::vector<SteeredFlip> read_steered_flips(const SQLite::Database& database, const TrialRecord& trial);

} // namespace overt
