/// What is known of one refresh of the display: the row of the flip ledger.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "experiment/animation.h"
#include "experiment/session_time.h"

namespace overt {

/// Counts refreshes of the display since the presenter was opened.
struct RefreshIndex {
    std::int64_t value = 0;
    friend constexpr auto operator<=>(const RefreshIndex&, const RefreshIndex&) = default;
};

/// Where a time of vertical blank comes from.
enum class VblankSource : std::uint8_t {
    virtual_display,  ///< our own display clock: exact by construction
    swap_return,      ///< the time at which the buffer swap and a glFinish returned
    glx_sync_control, ///< GLX_OML_sync_control: the refresh the swap was lit at
    present_swap,     ///< the X server's Present extension: the refresh the swap was lit at
    present_count,    ///< the same, which only counts: the first refresh after the swap
    egl_sync_control, ///< EGL_CHROMIUM_sync_control: the refresh the swap was lit at
    drm_vblank,       ///< the kernel's count for the screen: the first refresh after the swap
    glx_video_sync,   ///< GLX_SGI_video_sync, which only counts: the first refresh after the swap
};
std::string_view name_of(VblankSource source);

/// Whether it counts refreshes, too; else the count is inferred from the times.
constexpr bool counts_refreshes(VblankSource source) { return source != VblankSource::swap_return; }

/// The refresh at which a picture became visible, in session time.
struct FlipReport {
    RefreshIndex refresh;
    SessionTime requested;      ///< when flip() was called
    SessionTime swapped;        ///< when the swap had been handed over
    SessionTime vertical_blank; ///< when scan-out of this refresh began
    VblankSource source = VblankSource::virtual_display;
    /// How far vertical_blank may be off, as its source has it; 0 where it is exact by construction.
    SessionDuration uncertainty{};
};

/// What a plan has for a refresh after its end.
inline constexpr AnimationFrameIndex no_frame{-1};

/// A row of the ledger: what was planned for a refresh of a presentation, and what was shown.
struct FlipRecord {
    int trial = 0;
    int refresh_in_trial = 0; ///< since the onset of the attempt's first show, by the display's count
    AnimationFrameIndex
        planned;               ///< for this refresh; no_frame where the plan had ended, or the slot was empty
    AnimationFrameIndex shown; ///< no_frame: the slot was empty
    PoseIndex pose;
    FlipReport report;
    /// Refreshes that went by with the picture before since the one that this was for. The ledger says so
    /// while it is written, and LedgerFit again where the source of the times counts none.
    int missed_refreshes = 0;
    /// Which of the attempt's steps shows it, from 1; 0: the only one that shows anything.
    int step = 0;
};

/// What a flip showed in a further slot; that of the trial's first stimulus is in the FlipRecord. A refresh
/// that was missed left what was there in all slots.
struct SlotFlip {
    int trial = 0;
    int refresh_in_trial = 0;         ///< of the flip
    int place = 1;                    ///< among what the trial shows (Trial::shown)
    AnimationFrameIndex planned = {}; ///< as in the FlipRecord
    AnimationFrameIndex shown = {};   ///< no_frame: the slot was empty
    PoseIndex pose = {};
    friend constexpr bool operator==(const SlotFlip&, const SlotFlip&) = default;
};

/// What the observer had moved a slot to, as a flip shows it: for each flip of a show in which a match or a
/// motion of kind "observer" decides what the slot shows. Frame and pose are in the FlipRecord, or in the
/// SlotFlip.
struct SteeredFlip {
    int trial = 0;
    int refresh_in_trial = 0; ///< of the flip
    int place = 0;            ///< among what the trial shows (Trial::shown)
    int level = -1;           ///< of a match, among its levels from 0; -1: the slot has none
    /// Of the latest input that the picture contains; nothing: it stands as it began.
    std::optional<SessionTime> input_at = {};
    friend constexpr bool operator==(const SteeredFlip&, const SteeredFlip&) = default;
};

/// The other kind of row: a refresh within the time of the plan that went by with the picture before it.
/// Together with the flips, each refresh from the onset to the plan's end has one row.
struct MissedRefresh {
    int trial = 0;
    int refresh_in_trial = 0;
    RefreshIndex refresh;
    AnimationFrameIndex planned; ///< not seen at this refresh
    AnimationFrameIndex shown;   ///< that stayed
    PoseIndex pose;              ///< of the frame that stayed
    SessionTime vertical_blank;  ///< on the straight line between the flips before and after
    SessionDuration uncertainty{};
    friend constexpr bool operator==(const MissedRefresh&, const MissedRefresh&) = default;
};

} // namespace overt
