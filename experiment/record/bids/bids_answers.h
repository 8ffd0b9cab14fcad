/// Spoken answers beside a BIDS dataset: in `sourcedata`, where BIDS asks nothing of files.
#pragma once

#include <filesystem>

#include "experiment/record/bids/bids_names.h"
#include "experiment/record/read/session_record.h"

namespace overt {

/// How many attempts at trials of a run have one.
int count_answers(const SessionRecord& record, int run);

/// Copies them to `sourcedata`/sub-…/ses-…/beh, with a table of which belongs to which attempt. Throws
/// RecordError if a file is missing, or cannot be written.
void copy_bids_answers(const SessionRecord& record, int run, const BidsNames& names,
                       const std::filesystem::path& sourcedata);

} // namespace overt
