/// Waits for gaze while a step is shown.
#pragma once

#include <memory>
#include <optional>
#include <span>

#include "experiment/clock_map.h"
#include "experiment/events/gaze_condition.h"
#include "experiment/gaze.h"
#include "experiment/ports/area_view.h"
#include "experiment/ports/eye_tracker.h"
#include "experiment/protocol/protocol.h"
#include "experiment/timing/lit_frames.h"

namespace overt {

/// Where gaze is waited for: within a distance of a point, or on an area of the object that moves.
struct GazeAim {
    ScreenPoint point;
    std::shared_ptr<const AreaView> area; ///< null: the point
};

/// Tells a GazeCondition of each sample whether it is inside: of an area by the frame that was lit on the
/// gaze's row when the sample was taken. begin() may allocate; the rest neither allocates nor throws.
class GazeWatch {
  public:
    GazeWatch(const ScreenGeometry& screen, const DisplaySettings& display);

    /// A step begins at `since`: samples before it do not count. `readings`: of the tracker's clock and the
    /// session's; none: no sample counts of an area, and each of a point. `tracker`: whose samples come.
    void begin(const GazeWait& wait, GazeAim aim, SessionTime since, std::span<const ClockPair> readings,
               const TrackerDescription& tracker);
    /// No step waits for gaze any more; what was found stays.
    void end() noexcept { is_waiting_ = false; }

    void take(const GazeSample& sample) noexcept;
    /// Of the step's stimulus; with the first the step begins.
    void flipped(const FlipRecord& flip) noexcept;

    bool has_come() const noexcept { return is_waiting_ && condition_.is_true(); }
    const GazeCondition& condition() const noexcept { return condition_; }

  private:
    bool is_inside(const ScreenPoint& gaze, TrackerTime at) const noexcept;

    ScreenGeometry screen_;
    LitFrames lit_;
    GazeCondition condition_;
    GazeAim aim_;
    Degrees within_;
    SessionTime since_;
    Eye eye_ = Eye::right;
    std::optional<ClockMap> clock_;
    bool is_waiting_ = false;
    bool has_flipped_ = false;
};

} // namespace overt
