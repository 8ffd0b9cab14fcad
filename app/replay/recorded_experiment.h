/// What a recorded session was made from, found again.
#pragma once

#include <filesystem>
#include <optional>

#include "app/inputs/protocol_inputs.h"
#include "experiment/record/read/session_record.h"
#include "experiment/record/verify/record_comparison.h"

namespace overt {

/// Where the protocol's file lay, as far as the session tells: the paths in it start there. `files`: the
/// folder that was given for it instead; empty: none.
std::filesystem::path place_of_protocol(const SessionRecord& record, const std::filesystem::path& files);

/// The recorded texts, or the files of maps, do not have the hashes that were recorded with them; nothing if
/// they do. Throws InputError for a map that is not there.
std::optional<RecordDifference> changed_content(const SessionRecord& record);

/// Reads the recorded protocol, with what it names from place_of_protocol(). What is wrong is printed to
/// standard error; then throws FindingsPrinted with the remedy. Throws InputError if the session does not say
/// where the meshes lay, and `files` is empty.
Experiment recorded_experiment(const SessionRecord& record, const std::filesystem::path& files,
                               const std::filesystem::path& cache);

} // namespace overt
