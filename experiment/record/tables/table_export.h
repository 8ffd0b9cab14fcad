/// A session as tables for everyone else's tools.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>

#include "experiment/maps/surface_point.h"
#include "experiment/record/read/session_record.h"
#include "experiment/record/tables/participant_rows.h"
#include "experiment/record/tables/sample_rows.h"
#include "experiment/record/tables/table_writer.h"

namespace overt {

struct TableExportOptions {
    TableFormat format = TableFormat::tsv;
    bool overwrite = false;                          ///< replace an earlier export
    std::function<void(int done, int all)> progress; ///< told after each trial; may be empty
    FurtherColumns further = {};                     ///< of the samples
};

/// What was written.
struct TableExportCounts {
    std::int64_t trials = 0; ///< completed ones
    std::int64_t flips = 0;
    std::int64_t samples = 0;
    std::int64_t samples_without_gaze = 0;
    std::int64_t samples_on_object = 0;
    std::int64_t samples_off_plan = 0; ///< that the planned frame times would have put on another frame
    std::int64_t rows = 0, bytes = 0;  ///< of all tables
};

/// Gives the lookup for an object in a view, or null if there is none. What it gave is used until the next
/// call: tables ask once for each, other exports for each trial.
using LookupFor = std::function<const SurfaceLookup*(const ViewedObject& viewed)>;

/// The same of how an object of a material, by its place among the session's, is looked through; null if it
/// is not of clear glass. Asked after LookupFor for the same object, where far points are wanted.
using GlassFor = std::function<const GlassSight*(const ViewedObject& viewed, int material)>;

/// What each eye saw of a trial's stimulus: the same, unless the eyes had pictures of their own.
LookupsOfEyes lookups_in(const SessionHeader& header, const Trial& trial, const LookupFor& lookup_for);

/// Writes trials, flips, samples, the tracker's own events, events, responses and stimuli with a
/// dictionary.json that explains each column. The same session gives the same bytes, on every machine and at
/// any time: nothing of the wall clock is in them. Flips, samples and responses are those of completed
/// trials. Memory does not grow with the session.
///
/// `glass_for` is needed with FurtherColumns::far_points.
///
/// The directory appears when it is complete. Throws InputError if it exists and is not to be overwritten, or
/// is no earlier export; RecordError for a damaged session or a full disk.
TableExportCounts export_tables(const SessionRecord& record, const LookupFor& lookup_for,
                                const std::filesystem::path& directory,
                                const TableExportOptions& options = {}, const GlassFor& glass_for = {});

/// The table "participants" of several sessions together, which each export has of its own session alone; in
/// place of one that is there. Gives its file. Throws RecordError.
std::filesystem::path write_participants(const std::vector<ParticipantRow>& rows,
                                         const std::filesystem::path& directory, TableFormat format);
/// Where it lies.
std::filesystem::path participants_file(const std::filesystem::path& directory, TableFormat format);

} // namespace overt
