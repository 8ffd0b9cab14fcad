/// Sessions as a BIDS dataset with eye tracking.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "experiment/record/read/session_record.h"
#include "experiment/record/tables/table_export.h"

namespace overt {

struct BidsExportOptions {
    bool overwrite = false;    ///< replace this session's files of this task, if they are there
    bool with_answers = false; ///< copy the spoken answers into `sourcedata`
    std::function<void(int done, int all)> progress; ///< told after each run; may be empty
};

/// What was written.
struct BidsExportCounts {
    int runs = 0, recordings = 0; ///< a recording is of one eye in one run
    std::int64_t samples = 0, rows = 0, bytes = 0;
    std::vector<std::string> remarks; ///< whole sentences
};

/// Writes a session into the dataset, which is made if it is not there: behavioural data with eye tracking as
/// BIDS 1.11 has it, and places on the surface as a derivative. Spoken answers are left out unless they are
/// asked for: a voice tells who somebody is. Other sessions and other files of the dataset stay as they are.
/// The session's files appear when all of them are complete. The same session gives the same bytes. Memory
/// does not grow with the session.
///
/// Throws InputError if the folder is no dataset of overt, if this session is in it and is not to be
/// overwritten, or if the screen's size and distance are not known; RecordError for a damaged session or a
/// full disk.
BidsExportCounts export_bids(const SessionRecord& record, const LookupFor& lookup_for,
                             const std::filesystem::path& dataset, const BidsExportOptions& options = {});

} // namespace overt
