/// What happened to the observer in a run, as BIDS has it: trials, screens and answers.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "experiment/record/read/session_record.h"

namespace overt {

/// The path of a stimulus under the dataset's folder "stimuli"; empty if there is no such file.
using StimulusFile = std::function<std::string(const Stimulus&)>;

/// Writes STEM.tsv and STEM.json: per attempt at a trial a row for it, and for each screen that it got to.
/// Onsets count from `zero` (see bids_zero), or from the session's begin. Throws InputError if the size or
/// distance of the screen is not known, for BIDS requires both; RecordError.
void write_bids_events(const SessionRecord& record, int run, std::optional<SessionTime> zero,
                       const StimulusFile& stimulus_file, const std::filesystem::path& stem);

} // namespace overt
