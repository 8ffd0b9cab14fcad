/// The folder of a BIDS dataset: what stands in it once, and how a session's files come into it.
#pragma once

#include <filesystem>

#include "experiment/record/bids/bids_names.h"

namespace overt {

/// Throws InputError if the folder holds anything that is no dataset of overt, or files of this session and
/// task that are not to be overwritten.
void check_bids_dataset(const std::filesystem::path& dataset, const BidsNames& names, bool overwrite);

/// Writes the files that describe a dataset and its derivatives, where they are not there.
void describe_bids_dataset(const std::filesystem::path& dataset, const SessionHeader& header);

/// Moves what lies in `staged` to the same places in `dataset`, after removing the files of this session and
/// task there. Throws RecordError.
void merge_into_bids_dataset(const std::filesystem::path& staged, const std::filesystem::path& dataset,
                             const BidsNames& names);

} // namespace overt
