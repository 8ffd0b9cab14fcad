/// How an object, and its light, turn while they are shown, and the table by which the frames are shown.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "experiment/base/enum_names.h"
#include "experiment/motion_kinds.h"
#include "experiment/object_pose.h"
#include "experiment/observer_turn.h"
#include "experiment/units.h"

namespace overt {

/// Which of the animation's frames: 0 … frame_count-1. It lasts several refreshes of the display.
struct AnimationFrameIndex {
    int value = 0;
    friend constexpr auto operator<=>(const AnimationFrameIndex&, const AnimationFrameIndex&) = default;
};

/// Which of the distinct ways in which objects stand over all motions: frames in which they stand alike share
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

/// How a motion at one speed begins and ends a way. `minimum_jerk`: 10 s^3 - 15 s^4 + 6 s^5 of the way at the
/// share s of its time (Flash and Hogan 1985, J. Neurosci. 5:1688).
enum class MotionEase : std::uint8_t { none, minimum_jerk };
template <> inline constexpr auto names_of<MotionEase> = enum_names<MotionEase>("none", "minimum-jerk");

/// What is between two rows of a table of places. `step`: the former; `linear`: on a straight line, turned at
/// one speed.
enum class BetweenKeys : std::uint8_t { step, linear };
template <> inline constexpr auto names_of<BetweenKeys> = enum_names<BetweenKeys>("step", "linear");

/// Which of the recorded trials a trial shows again: one in which the same stimulus stood in the same slot,
/// or the one with its own number.
enum class CourseMatch : std::uint8_t { stimulus, trial };
template <> inline constexpr auto names_of<CourseMatch> = enum_names<CourseMatch>("stimulus", "trial");

/// How object and light stand in a frame. With the camera of a view it is all that a picture of an object in
/// a material and a light depends on.
struct Pose {
    ObjectPose object;
    Degrees light; ///< turned about the vertical from where the protocol has it, counter-clockwise from above
    friend bool operator==(const Pose&, const Pose&) = default;
};

inline bool is_same_pose(const Pose& a, const Pose& b) {
    return is_same_object_pose(a.object, b.object) && is_same_turn(a.light, b.light);
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
    Degrees light_amplitude{0.0}; ///< the light's turn to each side, as a sine in step with `turn`
    int light_turns =
        0; ///< full turns of the light while the frames go by once, at one speed; < 0: clockwise
    ObserverTurn by_observer; ///< of `observer`, whose frames are its poses
    // What is about `axis` through `pivot` comes after `angle`.
    std::optional<glm::dvec3> axis;     ///< of the object's turn, not 0; left out: the vertical
    std::optional<glm::dvec3> pivot;    ///< from the centre of the object's box, in the unit of its mesh
    int turns = 1;                      ///< of `turntable` and `orbit`: while the frames go by once
    double rest_share = 0.25;           ///< of `trapezoid`: of its time, at both ends together
    MotionEase ease = MotionEase::none; ///< of `triangle` and `trapezoid`
    std::vector<double> angles_deg;     ///< of `steps`
    std::vector<std::array<double, 3>> waves;  ///< amplitude / deg, periods in all frames, phase / deg
    double approach = 0.0;                     ///< of `approach`: towards -y, in the unit of the mesh
    std::filesystem::path keyframes;           ///< of `keyframes`: a table
    BetweenKeys between = BetweenKeys::linear; ///< its rows
    std::vector<std::string> recorded;         ///< of `recorded`: tables
    CourseMatch matched_by = CourseMatch::stimulus;
    /// How object and light stand in each frame, where it does not follow from the above: by a table, or as
    /// it was recorded. Else empty.
    std::vector<Pose> given;

    /// The turn of the object about the vertical in a frame, counter-clockwise seen from above: all of how it
    /// stands, where it is_turn().
    Degrees angle_of(AnimationFrameIndex frame) const { return object_in(frame).angle; }

    /// How the object stands in a frame. Frames that share a pose get bit-identical numbers.
    ObjectPose object_in(AnimationFrameIndex frame) const { return pose_of(frame).object; }

    /// Object and light.
    Pose pose_of(AnimationFrameIndex frame) const;

    /// Whether anything does.
    bool moves() const;

    /// See MotionLaw::has_plan.
    bool has_plan() const { return law_of(kind).has_plan; }

    /// The poses that differ, in order of first appearance: what a frame store has to hold of it.
    std::vector<Pose> pictures() const;

    /// The largest turn of the object about the vertical from its front to either side, 0 … 180 degrees.
    Degrees largest_turn() const;

    /// Whether the light is turned in any frame. What tells the pictures of a movie apart is no light.
    bool turns_light() const;

    /// Whether the object is turned about the vertical in some frames, and nothing else in all of them.
    bool only_turns() const;

    /// How many frames one presentation shows: duration times rate, to the nearest whole frame.
    int shown_frame_count() const;

    /// Which frame is the `step`-th shown (step >= 0). Without a plan nobody knows beforehand: all in turn.
    AnimationFrameIndex frame_at_step(int step) const;

    /// How many steps until the order of frames repeats.
    int steps_per_period() const;
};

/// The distinct ways in which the object stands over all motions of a protocol, in order of first appearance.
/// Motions that share them share poses, and with them maps.
struct PoseTable {
    std::vector<ObjectPose> angles; ///< by PoseIndex
    /// By motion, and then by AnimationFrameIndex.
    std::vector<std::vector<PoseIndex>> of_motion;

    PoseIndex pose_of(int motion, AnimationFrameIndex frame) const {
        return of_motion[static_cast<std::size_t>(motion)][static_cast<std::size_t>(frame.value)];
    }
    std::span<const PoseIndex> frames_of(int motion) const {
        return of_motion[static_cast<std::size_t>(motion)];
    }
    const ObjectPose& object_of(PoseIndex pose) const { return angles[static_cast<std::size_t>(pose.value)]; }
    int count() const { return static_cast<int>(angles.size()); }
    /// Of one that is among them.
    PoseIndex index_of(const ObjectPose& object) const;

    /// Adds a motion, which gets the next number.
    void add(const Animation& motion);
};

/// Of a protocol with one motion.
PoseTable distinct_poses(const Animation& motion);

/// How long one presentation of a motion shows each pose as planned, in seconds; by PoseIndex. What has no
/// plan is as long in each pose as in any other.
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
