/// A session in EyeLink's text form (ASC).
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>

#include "experiment/record/read/session_record.h"

namespace overt {

struct AscExportOptions {
    bool overwrite = false;                          ///< replace an earlier export
    bool fractional_times = false;                   ///< times with their microseconds
    bool opensesame_messages = false;                ///< start_trial, end_trial, phases and variables, too
    std::function<void(int done, int all)> progress; ///< told after each trial; may be empty
};

/// What was written.
struct AscExportCounts {
    int files = 0;
    int sittings_without_samples = 0; ///< they have no file, unless their events were imported
    std::int64_t trials = 0, samples = 0, lines = 0, bytes = 0;
};

/// Writes a file for each sitting, for the tracker may have been started anew between them:
/// sub-LABEL_ses-NN_run-NN.asc. All attempts at trials are in it, with all their samples. Times are whole
/// milliseconds of the tracker's clock, or less a number of seconds that the header names where they would
/// not fit into 31 bits; coordinates and pupils have the decimals of the tables. Memory does not grow with
/// the session.
///
/// The directory appears when it is complete. Throws InputError if it exists and is not to be overwritten, or
/// is no earlier export, or if the session has neither samples nor imported events; RecordError for a damaged
/// session or a full disk.
AscExportCounts export_asc(const SessionRecord& record, const std::filesystem::path& directory,
                           const AscExportOptions& options = {});

} // namespace overt
