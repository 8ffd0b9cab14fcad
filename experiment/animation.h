/// How an object, and its light, turn while they are shown, and the table by which the frames are shown.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "experiment/base/enum_names.h"
#include "experiment/observer_turn.h"
#include "experiment/units.h"

namespace overt {

/// Which of the animation's frames: 0 … frame_count-1. It lasts several refreshes of the display.
struct AnimationFrameIndex {
    int value = 0;
    friend constexpr auto operator<=>(const AnimationFrameIndex&, const AnimationFrameIndex&) = default;
};

/// Which of the distinct turns that objects are seen in over all motions: frames with the same angle share
/// one, whatever motion they are of and wherever the light stands.
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

/// What the object does. `turn`: it goes to and fro about the vertical, as a sine. `still`: it keeps its
/// angle. `observer`: it stands as the observer turns it.
enum class MotionKind : std::uint8_t { turn, still, observer };
template <> inline constexpr auto names_of<MotionKind> = enum_names<MotionKind>("turn", "still", "observer");

/// How object and light stand in a frame, about the vertical and counter-clockwise seen from above. With the
/// camera of a view it is all that a picture of an object in a material and a light depends on.
struct Pose {
    Degrees object; ///< turned from its front
    Degrees light;  ///< turned from where the protocol has it
    friend constexpr bool operator==(const Pose&, const Pose&) = default;
};

/// Whether two turns are one: motions come to the same angle by different sums, and 25 sin(30 deg) is
/// not 12.5 to the last bit.
constexpr bool is_same_turn(Degrees a, Degrees b) {
    constexpr double rounding_deg = 1e-9;
    return a.value - b.value <= rounding_deg && b.value - a.value <= rounding_deg;
}
constexpr bool is_same_pose(const Pose& a, const Pose& b) {
    return is_same_turn(a.object, b.object) && is_same_turn(a.light, b.light);
}

/// A motion. Source of the defaults: Sidorov, Harvey, Smithson and Hardeberg 2019, section 4.1.
struct Animation {
    int frame_count = 61;
    double frame_rate_hz = 30.0;
    Degrees amplitude{25.0}; ///< of `turn`: to each side of `angle`
    Playback playback = Playback::cycle;
    double duration_s = 8.0; ///< of one presentation
    WhenLate when_late = WhenLate::drop;
    MotionKind kind = MotionKind::turn;
    Degrees angle{0.0}; ///< from the front view: the middle of a turn, or where a still object stands
    Degrees light_amplitude{0.0}; ///< the light's turn to each side, in step with the object's
    ObserverTurn by_observer;     ///< of `observer`, whose frames are its poses

    /// The angle of the object in a frame, counter-clockwise seen from above: of `observer` that of its pose,
    /// else `angle`, and of `turn` with
    /// cycle a sin(2 pi k / (n-1)), with ping_pong -a cos(pi k / (n-1)) on top of it. Frames that share a
    /// pose get bit-identical angles.
    Degrees angle_of(AnimationFrameIndex frame) const;

    /// Object and light. The light's turn has the light's amplitude in place of a, and no angle on top.
    Pose pose_of(AnimationFrameIndex frame) const;

    /// Whether anything does.
    bool moves() const { return kind != MotionKind::still || light_amplitude.value != 0.0; }

    /// The poses that differ, in order of first appearance: what a frame store has to hold of it.
    std::vector<Pose> pictures() const;

    /// The largest turn of the object from its front to either side, 0 … 180 degrees.
    Degrees largest_turn() const;

    /// How many frames one presentation shows: duration times rate, to the nearest whole frame.
    int shown_frame_count() const;

    /// Which frame is the `step`-th shown (step >= 0). Of `observer` nobody knows beforehand: all in turn.
    AnimationFrameIndex frame_at_step(int step) const;

    /// How many steps until the order of frames repeats.
    int steps_per_period() const;
};

/// The distinct turns of the object over all motions of a protocol, in order of first appearance. Motions
/// that share angles share poses, and with them maps.
struct PoseTable {
    std::vector<Degrees> angles; ///< by PoseIndex
    /// By motion, and then by AnimationFrameIndex.
    std::vector<std::vector<PoseIndex>> of_motion;

    PoseIndex pose_of(int motion, AnimationFrameIndex frame) const {
        return of_motion[static_cast<std::size_t>(motion)][static_cast<std::size_t>(frame.value)];
    }
    std::span<const PoseIndex> frames_of(int motion) const {
        return of_motion[static_cast<std::size_t>(motion)];
    }
    Degrees angle_of(PoseIndex pose) const { return angles[static_cast<std::size_t>(pose.value)]; }
    int count() const { return static_cast<int>(angles.size()); }
    /// Of a turn that is among the angles.
    PoseIndex index_of(Degrees turn) const;

    /// Adds a motion, which gets the next number.
    void add(const Animation& motion);
};

/// Of a protocol with one motion.
PoseTable distinct_poses(const Animation& motion);

/// How long one presentation of a motion shows each pose as planned, in seconds; by PoseIndex. What the
/// observer turns is as long in each pose as in any other.
std::vector<double> seconds_of_poses(const Animation& animation, const PoseTable& poses, int motion);

/// The pictures of a motion: which pose each shows, and how long a presentation shows it as planned.
struct ShownPictures {
    std::vector<PoseIndex> poses; ///< by the number of the picture among Animation::pictures()
    std::vector<double> seconds;  ///< likewise
    std::vector<int> of_frame;    ///< by AnimationFrameIndex
};
ShownPictures shown_pictures(const Animation& animation, std::span<const PoseIndex> pose_of_frame);

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

/// Of a motion whose frames have these poses. Throws InputError if refreshes_per_frame is 0.
PageCycle make_page_cycle(const Animation& animation, std::span<const PoseIndex> pose_of_frame,
                          double refresh_hz);

/// Of the only motion.
PageCycle make_page_cycle(const Animation& animation, double refresh_hz);

} // namespace overt
