/// Where a gaze sample belongs: when it was taken by the session's clock, on which frame, at which place of
/// the surface.
#pragma once

#include <optional>

#include <glm/glm.hpp>

#include "experiment/analysis/flip_history.h"
#include "experiment/analysis/surface_point.h"
#include "experiment/clock_map.h"
#include "experiment/gaze.h"
#include "experiment/record/session_record.h"
#include "experiment/screen_geometry.h"

namespace overt {

struct JoinedSample {
    std::optional<MappedTime> at;        ///< nothing if the clocks were never read together
    std::optional<glm::dvec2> image_px;  ///< continuous image point, also outside of it; nothing without gaze
    std::optional<LitFrame> shown;       ///< the frame lit at the gaze's row; nothing without gaze or time
    std::optional<SurfacePoint> surface; ///< nothing beside the object, or without a lookup
    bool off_plan = false;               ///< see FlipHistory::is_off_plan
};

/// Joins the samples of one trial. May be used from any thread.
class SampleJoin {
  public:
    /// `lookup` answers for the trial's sculpture and outlives this; null if there is none. Throws
    /// RecordError.
    SampleJoin(const SessionRecord& record, const TrialRecord& trial, const SurfaceLookup* lookup);

    JoinedSample join(const GazeSample& sample) const;

  private:
    ScreenGeometry screen_;
    std::optional<ClockMap> clock_map_;
    FlipHistory flip_history_;
    const SurfaceLookup* lookup_;
};

} // namespace overt
