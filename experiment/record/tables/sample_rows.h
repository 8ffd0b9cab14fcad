/// The gaze of trials as rows of the table of samples.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "experiment/analysis/gaze_cone.h"
#include "experiment/maps/glass_sight.h"
#include "experiment/record/read/sample_counts.h"
#include "experiment/record/read/tracker_facts.h"
#include "experiment/record/tables/joined_cells.h"
#include "experiment/record/tables/shared_columns.h"
#include "experiment/study/fixations/passing_fixations.h"

namespace overt {

/// How many samples are joined and written at a time: memory does not depend on a trial's length.
inline constexpr std::size_t samples_at_a_time = 16384;

/// What the table of samples has by request.
struct FurtherColumns {
    std::optional<Degrees> cone_accuracy = {}; ///< the shares of a gaze cone (see GazeCone) of this accuracy
    bool far_points = false;                   ///< what was looked at through glass (see GlassSight)
};

/// How each eye sees through a stimulus; null where it is not of clear glass.
struct GlassOfEyes {
    const GlassSight *left = nullptr, *right = nullptr;
    const GlassSight* of(Eye eye) const { return eye == Eye::left ? left : right; }
};

struct SampleCells : JoinedRow {
    std::optional<int> trial;                  ///< from 1; nothing: of no trial
    const std::string &task, &slot;            ///< as cells
    const std::vector<std::string>& stimulus;  ///< a cell for each column of stimuli
    const std::vector<std::string>& own_parts; ///< of the object, by PartIndex
    const GazeCone::Shares* shares;            ///< null without a cone, and beside lit frames
    std::optional<FarPoint> far;               ///< nothing where it is not asked for, too
};

/// `pupil`: see pupil_words(). `header` must outlive it.
RowLayout<SampleCells> samples_layout(const SharedColumns& shared, const SessionHeader& header,
                                      const PupilWords& pupil, const FurtherColumns& further);

class SampleRows {
  public:
    /// `layout`, with the same further columns, and `record` must outlive this.
    SampleRows(const RowLayout<SampleCells>& layout, const SessionRecord& record, TableFormat format,
               const FurtherColumns& further);

    /// Writes the samples of a trial as the presentation in its slot has them (TrialRecord::seen_in), made on
    /// all processors; `lookups`, by eye, are null if its object has no surface, `glass` is what it is looked
    /// through with, by eye. They pass by `fixations`, too. Throws RecordError.
    SampleCounts write(TableWriter& to, const TrialRecord& trial, const std::optional<TrialLedger>& ledger,
                       const LookupsOfEyes& lookups, const GlassOfEyes& glass, PassingFixations& fixations);
    /// The same of those between the trial's result and the next trial, which are of none.
    SampleCounts write_after(TableWriter& to, const TrialRecord& trial);

  private:
    struct Piece {
        std::span<const GazeSample> samples;
        std::optional<int> trial; ///< from 1; nothing: of none
        const SampleJoin& join;
        const LookupsOfEyes& lookups;
        const GlassOfEyes& glass;
        const std::string &task, &slot;           ///< as cells
        const std::vector<std::string>& stimulus; ///< a cell for each of their columns
        const GazeCone* cone;                     ///< null: none
        const std::vector<std::string>&parts, &own_parts;
        const PassingFixations* fixations; ///< null: of none
    };
    SampleCounts write_batch(TableText& to, std::vector<PlacedSample>& placed, const Piece& piece) const;
    SampleCounts write_all(TableWriter& to, const TrialRecord& trial, const SampleJoin& join,
                           const LookupsOfEyes& lookups, const GlassOfEyes& glass,
                           PassingFixations* fixations) const;
    static std::vector<GazeCone::Shares> cone_shares(const Piece& piece,
                                                     std::span<const JoinedSample> joined);

    const RowLayout<SampleCells>& layout_;
    const SessionRecord& record_;
    const SessionHeader& header_;
    TableFormat format_;
    std::vector<GazeCone> cones_; ///< by slot; none: no cone is asked for
    const std::string nothing_;   ///< a cell
    const std::vector<StimulusColumn> columns_;
    const std::vector<std::string> no_stimulus_; ///< cells
};

} // namespace overt
