/// The gaze of trials as rows of the table of samples.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "experiment/analysis/gaze_cone.h"
#include "experiment/record/tables/export_tables.h"
#include "experiment/record/tables/joined_cells.h"

namespace overt {

/// How many samples are joined and written at a time: memory does not depend on a trial's length.
inline constexpr std::size_t samples_at_a_time = 16384;

/// Of one trial.
struct SampleCounts {
    std::int64_t samples = 0, without_gaze = 0, on_object = 0, off_plan = 0;
};

class SampleRows {
  public:
    /// `record` and `tables` must outlive this. With a cone, `tables` must have its columns.
    SampleRows(TableWriter& writer, const SessionRecord& record, const ExportTables& tables,
               std::optional<Degrees> cone_accuracy);

    /// Writes the samples of a trial; `lookup` is null if its sculpture has no surface. Throws RecordError.
    SampleCounts write(const TrialRecord& trial, const std::optional<TrialLedger>& ledger,
                       const SurfaceLookup* lookup);

  private:
    void write_piece(std::span<const GazeSample> samples, const TrialRecord& trial, const SampleJoin& join,
                     const SurfaceLookup* lookup);
    void write_gaze(const GazeSample& sample);
    std::vector<GazeCone::Shares> cone_shares(const SurfaceLookup& lookup,
                                              std::span<const GazeSample> samples, std::size_t parts) const;
    void write_cone(const GazeCone::Shares& shares, int sculpture);

    TableWriter& row_;
    const SessionRecord& record_;
    const SessionHeader& header_;
    const ExportTables& tables_;
    std::optional<GazeCone> cone_;
    std::vector<JoinedSample> joined_; ///< of the piece being written
    SampleCounts counts_;
};

} // namespace overt
