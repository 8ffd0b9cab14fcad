/// The columns by which tables name a stimulus: its index in each list.
#pragma once

#include <string>

#include "experiment/record/sql.h"

namespace overt {

/// "object, material, light, …": to insert a Stimulus into.
std::string stimulus_columns();

/// The same to select a Stimulus by, with 0 for lists that a table of an earlier program does not know.
std::string stimulus_columns_of(const SQLite::Database& database, const char* table);

/// A question mark for each, with a comma before it.
std::string marks_of_stimulus();

/// Their declarations in place of each "@stimulus" of a statement, and stimulus_columns() of "@indices".
std::string with_stimulus_columns(std::string sql);

} // namespace overt
