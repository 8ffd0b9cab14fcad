/// Which frame was lit on a row of the screen at an instant: the flip ledger of one presentation, read
/// backwards.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "experiment/animation.h"
#include "experiment/flip_report.h"
#include "experiment/session_time.h"
#include "experiment/timing/lit_frames.h"

namespace overt {

struct LitFrame {
    AnimationFrameIndex frame;
    PoseIndex pose;       ///< of that frame
    RefreshIndex refresh; ///< at which this row of the picture came up
};

/// What a gaze of some time and row fell on, and whether the plan says otherwise.
struct Lighting {
    std::optional<LitFrame> shown;
    bool off_plan = false;
};

/// Answers for one presentation. May be asked from any thread.
///
/// Row y of refresh r is lit from vertical_blank(r) + latency + y / screen_rows * one nominal refresh until
/// the same row of the next refresh in the ledger (so a picture that stays because a refresh was dropped
/// stays here too); after the last one, for one nominal refresh. Rows above and below the screen are taken as
/// its first and last.
class FlipHistory {
  public:
    /// The ledger's rows of one trial, in any order, and the page cycle that the presentation was to follow.
    FlipHistory(std::span<const FlipRecord> flips, const ScanOut& scan_out, const PageCycle& plan);

    /// Nothing before the presentation's onset and after its end.
    std::optional<LitFrame> frame_shown_at(SessionTime time, double row_px) const;

    /// The frame that the plan had for this instant, row included: refreshes counted from the recorded onset
    /// at the nominal rate, as if none had ever been late. What analyses go by that have no ledger.
    std::optional<AnimationFrameIndex> frame_planned_at(SessionTime time, double row_px) const;

    /// frame_shown_at and is_off_plan together.
    Lighting lighting_at(SessionTime time, double row_px) const;

    /// Going by the plan would put a gaze of this time and row on another frame than was lit, or on one where
    /// none was lit. Within a microsecond of a change of frames the two never differ: that is rounding.
    bool is_off_plan(SessionTime time, double row_px) const;

  private:
    /// Index of the picture that was lit, or of the planned refresh; -1 where there is none.
    std::ptrdiff_t picture_at(SessionTime blank) const;
    std::ptrdiff_t planned_at(SessionTime blank) const;
    bool is_on_plan(std::ptrdiff_t picture, SessionTime blank) const;
    bool is_off_plan(std::ptrdiff_t picture, SessionTime blank) const;

    ScanOut scan_out_;
    double refresh_ns_;
    std::vector<SessionTime> blanks_; ///< rising
    std::vector<LitFrame> pictures_;  ///< by index of blanks_
    SessionTime end_;
    // By refresh of the plan; the blanks have one more, the end.
    std::vector<SessionTime> planned_blanks_;
    std::vector<AnimationFrameIndex> planned_frames_;
    /// For equal steps of time since the first blank, the number of blanks up to then: where to look.
    std::vector<std::uint32_t> blanks_before_step_;
    double steps_per_ns_ = 0.0;
};

} // namespace overt
