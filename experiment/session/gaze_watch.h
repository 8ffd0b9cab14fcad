/// Waits for gaze while a step is shown.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "experiment/clock_map.h"
#include "experiment/events/gaze_condition.h"
#include "experiment/gaze.h"
#include "experiment/ports/area_view.h"
#include "experiment/ports/eye_tracker.h"
#include "experiment/protocol/protocol.h"
#include "experiment/timing/lit_frames.h"

namespace overt {

/// An area of an object that moves in one of the slots that a step lights.
struct AimedArea {
    int place = 0; ///< of Trial::shown
    std::shared_ptr<const AreaView> area;
};

/// Where gaze is waited for: within a distance of a point, or on any of some areas.
struct GazeAim {
    ScreenPoint point;
    std::vector<AimedArea> areas; ///< none: the point
};

/// Tells a GazeCondition of each sample whether it is inside: of an area by the frame that was lit on the
/// gaze's row when the sample was taken. begin() may allocate; the rest neither allocates nor throws.
class GazeWatch {
  public:
    GazeWatch(const ScreenGeometry& screen, const DisplaySettings& display);

    /// A step begins at `since`: samples before it do not count. `readings`: of the tracker's clock and the
    /// session's; none: no sample counts of an area, and each of a point. `tracker`: whose samples come.
    /// `lead`: of the places that the step lights, the one whose flips flipped() tells.
    void begin(const GazeWait& wait, GazeAim aim, int lead, SessionTime since,
               std::span<const ClockPair> readings, const TrackerDescription& tracker);
    /// No step waits for gaze any more; what was found stays.
    void end() noexcept { is_waiting_ = false; }

    void take(const GazeSample& sample) noexcept;
    /// Of what the step lights: its lead, and rows of further places. With the first the step begins.
    void flipped(const FlipRecord& lead, std::span<const SlotFlip> further) noexcept;

    bool has_come() const noexcept { return is_waiting_ && condition_.is_true(); }
    const GazeCondition& condition() const noexcept { return condition_; }

  private:
    bool is_inside(const ScreenPoint& gaze, TrackerTime at) const noexcept;

    ScreenGeometry screen_;
    LitFrames nothing_lit_;
    std::vector<LitFrames> lit_; ///< of each area of the aim
    int lead_ = 0;
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
