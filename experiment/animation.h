/// The sinusoidal turn of an object and the table by which its frames are shown.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "experiment/base/enum_names.h"
#include "experiment/units.h"

namespace overt {

/// Which of the animation's frames: 0 … frame_count-1. It lasts several refreshes of the display.
struct AnimationFrameIndex {
    int value = 0;
    friend constexpr auto operator<=>(const AnimationFrameIndex&, const AnimationFrameIndex&) = default;
};

/// Which of the distinct poses that an animation goes through: frames with the same angle share one.
struct PoseIndex {
    int value = 0;
    friend constexpr auto operator<=>(const PoseIndex&, const PoseIndex&) = default;
};

/// How the frames follow one another. `cycle`: the frames hold one whole period of the sine, the last closing
/// the loop. `ping_pong`: they hold one sweep from one end to the other, played forth and back.
enum class Playback { cycle, ping_pong };
template <> inline constexpr auto names_of<Playback> = enum_names<Playback>("cycle", "ping-pong");

/// What becomes of the plan when a picture comes late. `drop`: the animation keeps time, and frames whose
/// time has passed are left out. `stretch`: every frame is lit for its refreshes, and the presentation ends
/// later.
enum class WhenLate { drop, stretch };
template <> inline constexpr auto names_of<WhenLate> = enum_names<WhenLate>("drop", "stretch");

/// The motion that all stimuli share. Source of the defaults: Sidorov, Harvey, Smithson and Hardeberg 2019,
/// section 4.1.
struct Animation {
    int frame_count = 61;
    double frame_rate_hz = 30.0;
    Degrees amplitude{25.0}; ///< to each side of the front view
    Playback playback = Playback::cycle;
    double duration_s = 8.0; ///< of one presentation
    WhenLate when_late = WhenLate::drop;

    /// Angle of a frame, counter-clockwise seen from above. cycle: a sin(2 pi k / (n-1)); ping_pong: -a
    /// cos(pi k / (n-1)). Frames that share a pose get bit-identical angles.
    Degrees angle_of(AnimationFrameIndex frame) const;

    /// How many frames one presentation shows: duration times rate, to the nearest whole frame.
    int shown_frame_count() const;

    /// Which frame is the `step`-th shown (step >= 0).
    AnimationFrameIndex frame_at_step(int step) const;

    /// How many steps until the order of frames repeats.
    int steps_per_period() const;
};

/// The distinct poses of an animation: angles in order of first appearance, and the pose of each frame.
struct PoseTable {
    std::vector<Degrees> angles;     ///< by PoseIndex
    std::vector<PoseIndex> of_frame; ///< by AnimationFrameIndex

    PoseIndex pose_of(AnimationFrameIndex frame) const {
        return of_frame[static_cast<std::size_t>(frame.value)];
    }
};
PoseTable distinct_poses(const Animation& animation);

/// How long one presentation shows each pose as planned, in seconds; by PoseIndex.
std::vector<double> seconds_of_poses(const Animation& animation, const PoseTable& poses);

/// One record of the page-cycle table: a page of the frame store, lit for a number of refreshes.
struct PageCycleEntry {
    AnimationFrameIndex frame;
    PoseIndex pose; ///< that the frame has
    int refreshes = 1;
};

/// What is lit at each refresh of a presentation, after the page cycling of the ViSaGe: entries in order,
/// repeated until total_refreshes are done.
struct PageCycle {
    std::vector<PageCycleEntry> entries;         ///< one period
    std::vector<std::uint16_t> entry_of_refresh; ///< index into entries for each refresh of one period
    int total_refreshes = 0;

    /// Entry lit at a refresh since onset, 0 <= refresh < total_refreshes.
    const PageCycleEntry& entry_at(int refresh) const;
};

/// The cycle for another number of refreshes, and with one of its frames all the time, if that is wished.
PageCycle cut_to(PageCycle cycle, std::optional<int> refreshes, std::optional<AnimationFrameIndex> still);

/// Refreshes that each frame is held, or 0 if the refresh rate is no whole multiple of the frame rate (to 0.2
/// %, so that 119.88 Hz counts as 120).
int refreshes_per_frame(double frame_rate_hz, double refresh_hz);

/// Throws InputError if refreshes_per_frame is 0.
PageCycle make_page_cycle(const Animation& animation, double refresh_hz);

} // namespace overt
