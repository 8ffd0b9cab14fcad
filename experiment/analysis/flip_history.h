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

/// Answers for one presentation, of as many shows as its slot was lit in. May be asked from any thread.
///
/// Row y of refresh r is lit from vertical_blank(r) + latency + y / screen_rows * one nominal refresh until
/// the same row of the next refresh in the ledger (so a picture that stays because a refresh was dropped
/// stays here too); after the last one of a show, for one nominal refresh. Rows above and below the screen
/// are taken as its first and last.
class FlipHistory {
  public:
    /// A show: its flips in any order, and the page cycle that it was to follow.
    struct Show {
        std::span<const FlipRecord> flips;
        PageCycle plan;
    };
    /// In their order.
    FlipHistory(std::span<const Show> shows, const ScanOut& scan_out);
    /// Of the only show.
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
    /// The pictures of one show, and its plan. Times are of vertical blanks, without the display's latency.
    class ShowHistory {
      public:
        ShowHistory(const Show& show, double refresh_hz);

        SessionTime onset() const { return blanks_.front(); }
        /// Index of the picture that was lit, or of the planned refresh; -1 where there is none.
        std::ptrdiff_t picture_at(SessionTime blank) const;
        std::ptrdiff_t planned_at(SessionTime blank) const;
        const LitFrame& picture(std::ptrdiff_t index) const {
            return pictures_[static_cast<std::size_t>(index)];
        }
        AnimationFrameIndex planned(std::ptrdiff_t index) const {
            return planned_frames_[static_cast<std::size_t>(index)];
        }
        bool is_off_plan(std::ptrdiff_t picture, SessionTime blank) const;

      private:
        bool is_on_plan(std::ptrdiff_t picture, SessionTime blank) const;

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
    /// The last that had begun, or the first; null if nothing was ever shown.
    const ShowHistory* show_at(SessionTime blank) const;

    ScanOut scan_out_;
    double refresh_ns_;
    std::vector<ShowHistory> shows_; ///< by their onsets
};

} // namespace overt
