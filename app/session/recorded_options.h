/// The options of `overt run` that decide what a session records: into the record, and back from it.
#pragma once

#include <filesystem>
#include <vector>

#include "app/session/session_commands.h"
#include "experiment/record/resumption.h"

namespace overt {

/// Those that were given, and "protocol", the way from the session's folder to the protocol's file. Left out
/// is what other tables hold (seed, number of the session, form, faults) and what does not change a record
/// (the window's screen, priorities, where sessions lie).
std::vector<RecordedOption> recorded_options(const RunOptions& options,
                                             const std::filesystem::path& session_folder);

/// The same backwards: sets in `options` what was recorded, and leaves the rest as it is. Throws RecordError
/// for an option that this version of the program does not know, or a value that it cannot have.
void take_recorded_options(const std::vector<RecordedOption>& recorded, RunOptions& options);

/// The value of the first of this name; null if there is none.
const std::string* recorded_value(const std::vector<RecordedOption>& recorded, std::string_view name);

} // namespace overt
