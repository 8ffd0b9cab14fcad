/// The gaze of trials as rows of the table of samples.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "experiment/analysis/gaze_cone.h"
#include "experiment/record/tables/joined_cells.h"
#include "experiment/record/tables/shared_columns.h"

namespace overt {

/// How many samples are joined and written at a time: memory does not depend on a trial's length.
inline constexpr std::size_t samples_at_a_time = 16384;

/// Of one trial.
struct SampleCounts {
    std::int64_t samples = 0, without_gaze = 0, on_object = 0, off_plan = 0;
};

struct SampleCells : JoinedRow {
    int trial;                                      ///< from 1
    const std::string &task, &sculpture, &material; ///< as cells
    const std::vector<std::string>& own_parts;      ///< of the sculpture, by PartIndex
    const GazeCone::Shares* shares;                 ///< null without a cone; empty beside lit frames
};

/// With the columns of a gaze cone if its accuracy is given. `header` must outlive it.
RowLayout<SampleCells> samples_layout(const SharedColumns& shared, const SessionHeader& header,
                                      std::optional<Degrees> cone_accuracy);

class SampleRows {
  public:
    /// `layout` and `record` must outlive this. With a cone, `layout` must have its columns.
    SampleRows(TableWriter& writer, const RowLayout<SampleCells>& layout, const SessionRecord& record,
               std::optional<Degrees> cone_accuracy);

    /// Writes the samples of a trial; `lookup` is null if its sculpture has no surface. Throws RecordError.
    SampleCounts write(const TrialRecord& trial, const std::optional<TrialLedger>& ledger,
                       const SurfaceLookup* lookup);

  private:
    void write_piece(std::span<const GazeSample> samples, const TrialRecord& trial, const SampleJoin& join,
                     const SurfaceLookup* lookup);
    std::vector<GazeCone::Shares> cone_shares(const SurfaceLookup& lookup,
                                              std::span<const GazeSample> samples, std::size_t parts) const;

    TableWriter& row_;
    const RowLayout<SampleCells>& layout_;
    const SessionRecord& record_;
    const SessionHeader& header_;
    std::optional<GazeCone> cone_;
    std::vector<JoinedSample> joined_; ///< of the piece being written
    SampleCounts counts_;
};

} // namespace overt
