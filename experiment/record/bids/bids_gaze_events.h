/// What the tracker said besides samples, as BIDS has it.
#pragma once

#include <filesystem>

#include "experiment/record/read/session_record.h"

namespace overt {

/// Writes STEM.tsv.gz and STEM.json with the events of an eye, and the messages of both, in the tracker's own
/// time. Where no tracker's file was imported, the messages say when trials and their screens began, by the
/// clocks' readings. Throws RecordError.
void write_bids_gaze_events(const SessionRecord& record, int run, Eye eye, const std::filesystem::path& stem);

} // namespace overt
