/// The gaze of one run as BIDS has it: per eye a packed table of samples and one of the tracker's events, and
/// beside them, as a derivative, where each sample was on the surface.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "experiment/record/bids/bids_names.h"
#include "experiment/record/read/session_record.h"
#include "experiment/record/tables/table_export.h"

namespace overt {

struct BidsGazeCounts {
    std::int64_t samples = 0, rows = 0, bytes = 0;
    int recordings = 0; ///< one of each eye
};

/// When a run's events count from: the first sample of the run, by the session's clock. Nothing without
/// samples or readings of the tracker's clock. Throws RecordError.
std::optional<SessionTime> bids_zero(const SessionRecord& record, int run);

/// Writes into `raw` and `derived`, the folders of the run's files. An object without a lookup has no
/// surface. Throws RecordError.
BidsGazeCounts write_bids_gaze(const SessionRecord& record, int run, const LookupFor& lookup_for,
                               const std::filesystem::path& raw, const std::filesystem::path& derived);

} // namespace overt
