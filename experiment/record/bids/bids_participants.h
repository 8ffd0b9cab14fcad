/// The observers of a BIDS dataset.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiment/record/read/session_record.h"

namespace overt {

/// Adds the session's observer to participants.tsv and participants.json in the dataset's folder, or what the
/// session knows of an observer who is there already and the table does not. Nothing that stands there is
/// changed: gives a sentence for each value that the session has otherwise. Throws InputError if the files
/// are damaged, RecordError if they cannot be written.
std::vector<std::string> add_bids_participant(const std::filesystem::path& dataset,
                                              const SessionRecord& record);

} // namespace overt
