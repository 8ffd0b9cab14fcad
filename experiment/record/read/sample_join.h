/// Where a gaze sample belongs: when it was taken by the session's clock, on which frame, at which place of
/// the surface.
#pragma once

#include <optional>
#include <span>

#include <glm/glm.hpp>

#include "experiment/analysis/flip_history.h"
#include "experiment/clock_map.h"
#include "experiment/gaze.h"
#include "experiment/maps/surface_point.h"
#include "experiment/record/read/session_record.h"
#include "experiment/screen_geometry.h"

namespace overt {

struct JoinedSample {
    std::optional<MappedTime> at;       ///< nothing if the clocks were never read together
    std::optional<glm::dvec2> image_px; ///< continuous image point, also outside of it; nothing without gaze
    std::optional<LitFrame> shown;      ///< the frame lit at the gaze's row; nothing without gaze or time
    Sight sight;                        ///< empty without a lit frame, or without a lookup
    /// Visual angle between the gaze and the nearest place of the outline of the object's picture (see
    /// PoseCells::outline_near): positive beside the object, negative on it. Nothing without a lit frame,
    /// or where the lookup knows no outline.
    std::optional<Degrees> outline_distance;
    bool off_plan = false; ///< see FlipHistory::is_off_plan
    /// Beside the slot's image, where the trial has others: neither lit nor on this slot's surface.
    bool is_elsewhere = false;
};

/// Joins the samples of one trial with the presentation in one of its slots (TrialRecord::seen_in). May be
/// used from any thread.
class SampleJoin {
  public:
    /// `lookups` answer for the trial's object and outlive this; null if there is none. Throws
    /// RecordError.
    SampleJoin(const SessionRecord& record, const TrialRecord& trial, const LookupsOfEyes& lookups);

    /// The same with the trial's ledger, where that was read already.
    SampleJoin(const SessionRecord& record, const TrialRecord& trial,
               const std::optional<TrialLedger>& ledger, const LookupsOfEyes& lookups);

    /// The same from its parts: without a clock map no sample has a time.
    SampleJoin(const ScreenGeometry& screen, std::optional<ClockMap> clock_map, FlipHistory history,
               const LookupsOfEyes& lookups, bool has_other_slots = false);

    /// Joins each sample; both spans are equally long. Faster than one by one.
    void join(std::span<const GazeSample> samples, std::span<JoinedSample> joined) const;

    JoinedSample join(const GazeSample& sample) const;

  private:
    void join_time_and_frame(const GazeSample& sample, JoinedSample& joined) const;
    void join_surfaces(std::span<const GazeSample> samples, std::span<JoinedSample> joined, Eye eye) const;

    ScreenGeometry screen_;
    std::optional<ClockMap> clock_map_;
    FlipHistory flip_history_;
    LookupsOfEyes lookups_;
    bool has_other_slots_;
};

} // namespace overt
