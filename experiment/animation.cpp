#include "experiment/animation.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "experiment/base/error.h"

namespace overt {

namespace {

/// sin(pi h / n) for a whole h, with the symmetries of the sine applied to the whole numbers first: equal
/// values come out bit-identical, and there is no negative zero.
double sine_of_half_turns(int h, int n) {
    h %= 2 * n;
    if (h < 0)
        h += 2 * n;
    const bool negative = h > n;
    if (negative)
        h -= n;
    h = std::min(h, n - h);
    if (h == 0)
        return 0.0;
    const double sine = std::sin(std::numbers::pi * h / n);
    return negative ? -sine : sine;
}

/// Where a motion is in a frame, -1 … 1.
double sine_of(const Animation& motion, AnimationFrameIndex frame) {
    OVERT_EXPECTS(frame.value >= 0 && frame.value < motion.frame_count);
    const int intervals = std::max(motion.frame_count - 1, 1);
    switch (motion.playback) {
    case Playback::cycle:
        return sine_of_half_turns(2 * frame.value, intervals);
    case Playback::ping_pong:
        // -cos(pi k / n) = sin(pi (2k - n) / 2n)
        return sine_of_half_turns(2 * frame.value - intervals, 2 * intervals);
    }
    return 0.0;
}

} // namespace

Degrees Animation::angle_of(AnimationFrameIndex frame) const {
    if (kind == MotionKind::observer)
        return by_observer.angle_of(frame.value);
    const double turn = kind == MotionKind::turn ? amplitude.value * sine_of(*this, frame) : 0.0;
    return {angle.value + turn};
}

Pose Animation::pose_of(AnimationFrameIndex frame) const {
    if (kind == MotionKind::observer)
        return {angle_of(frame), {0.0}};
    return {angle_of(frame), {light_amplitude.value * sine_of(*this, frame)}};
}

std::vector<Pose> Animation::pictures() const {
    std::vector<Pose> pictures;
    for (int frame = 0; frame < frame_count; ++frame) {
        const Pose pose = pose_of({frame});
        if (std::ranges::none_of(pictures, [&](const Pose& known) { return is_same_pose(known, pose); }))
            pictures.push_back(pose);
    }
    return pictures;
}

Degrees Animation::largest_turn() const {
    if (kind == MotionKind::observer) {
        const double most = std::max(std::abs(by_observer.from.value), std::abs(by_observer.to.value));
        return {by_observer.is_whole() ? 180.0 : std::min(most, 180.0)};
    }
    const double from_front = std::abs(std::remainder(angle.value, 360.0));
    return {std::min(from_front + (kind == MotionKind::turn ? std::abs(amplitude.value) : 0.0), 180.0)};
}

int Animation::shown_frame_count() const { return static_cast<int>(std::lround(duration_s * frame_rate_hz)); }

int Animation::steps_per_period() const {
    if (kind == MotionKind::observer)
        return frame_count;
    const int intervals = std::max(frame_count - 1, 1);
    return playback == Playback::cycle ? intervals : 2 * intervals;
}

AnimationFrameIndex Animation::frame_at_step(int step) const {
    OVERT_EXPECTS(step >= 0);
    const int intervals = std::max(frame_count - 1, 1);
    const int in_period = step % steps_per_period();
    if (frame_count == 1)
        return {0};
    if (kind == MotionKind::observer)
        return {in_period};
    // The closing frame of a cycle is the first of the next.
    return {in_period <= intervals ? in_period : 2 * intervals - in_period};
}

void PoseTable::add(const Animation& motion) {
    std::vector<PoseIndex>& poses = of_motion.emplace_back();
    for (int frame = 0; frame < motion.frame_count; ++frame) {
        const Degrees turned = motion.angle_of({frame});
        auto known = std::ranges::find_if(angles, [&](Degrees one) { return is_same_turn(one, turned); });
        if (known == angles.end())
            known = angles.insert(known, turned);
        poses.push_back({static_cast<int>(known - angles.begin())});
    }
}

PoseIndex PoseTable::index_of(Degrees turn) const {
    const auto found = std::ranges::find_if(angles, [&](Degrees one) { return is_same_turn(one, turn); });
    OVERT_EXPECTS(found != angles.end());
    return {static_cast<int>(found - angles.begin())};
}

PoseTable distinct_poses(const Animation& motion) {
    PoseTable poses;
    poses.add(motion);
    return poses;
}

std::vector<double> seconds_of_poses(const Animation& animation, const PoseTable& poses, int motion) {
    OVERT_EXPECTS(poses.frames_of(motion).size() >= static_cast<std::size_t>(animation.frame_count));
    std::vector<double> seconds(poses.angles.size(), 0.0);
    if (animation.kind == MotionKind::observer) {
        for (const PoseIndex pose : poses.frames_of(motion))
            seconds[static_cast<std::size_t>(pose.value)] += animation.duration_s / animation.frame_count;
        return seconds;
    }
    for (int step = 0; step < animation.shown_frame_count(); ++step)
        seconds[static_cast<std::size_t>(poses.pose_of(motion, animation.frame_at_step(step)).value)] +=
            1.0 / animation.frame_rate_hz;
    return seconds;
}

ShownPictures shown_pictures(const Animation& animation, std::span<const PoseIndex> pose_of_frame) {
    OVERT_EXPECTS(pose_of_frame.size() >= static_cast<std::size_t>(animation.frame_count));
    const std::vector<Pose> pictures = animation.pictures();
    ShownPictures shown;
    shown.poses.resize(pictures.size());
    shown.seconds.resize(pictures.size(), 0.0);
    for (int frame = 0; frame < animation.frame_count; ++frame) {
        const auto picture = std::ranges::find_if(
            pictures, [&](const Pose& pose) { return is_same_pose(pose, animation.pose_of({frame})); });
        shown.of_frame.push_back(static_cast<int>(picture - pictures.begin()));
        shown.poses[static_cast<std::size_t>(shown.of_frame.back())] =
            pose_of_frame[static_cast<std::size_t>(frame)];
    }
    if (animation.kind == MotionKind::observer) {
        for (const int picture : shown.of_frame)
            shown.seconds[static_cast<std::size_t>(picture)] += animation.duration_s / animation.frame_count;
        return shown;
    }
    for (int step = 0; step < animation.shown_frame_count(); ++step) {
        const auto frame = static_cast<std::size_t>(animation.frame_at_step(step).value);
        shown.seconds[static_cast<std::size_t>(shown.of_frame[frame])] += 1.0 / animation.frame_rate_hz;
    }
    return shown;
}

const PageCycleEntry& PageCycle::entry_at(int refresh) const {
    OVERT_EXPECTS(refresh >= 0 && refresh < total_refreshes);
    const std::size_t in_period = static_cast<std::size_t>(refresh) % entry_of_refresh.size();
    return entries[entry_of_refresh[in_period]];
}

int refreshes_per_frame(double frame_rate_hz, double refresh_hz) {
    const double ratio = refresh_hz / frame_rate_hz;
    const double nearest = std::round(ratio);
    return nearest >= 1.0 && std::abs(ratio - nearest) <= 2e-3 * nearest ? static_cast<int>(nearest) : 0;
}

PageCycle cut_to(PageCycle cycle, std::optional<int> refreshes, std::optional<AnimationFrameIndex> still) {
    if (refreshes)
        cycle.total_refreshes = *refreshes;
    if (!still)
        return cycle;
    const auto entry = std::find_if(cycle.entries.begin(), cycle.entries.end(),
                                    [&](const PageCycleEntry& one) { return one.frame == *still; });
    OVERT_EXPECTS(entry != cycle.entries.end());
    cycle.entries = {{entry->frame, entry->pose, 1}};
    cycle.entry_of_refresh = {0};
    return cycle;
}

PageCycle make_page_cycle(const Animation& animation, std::span<const PoseIndex> pose_of_frame,
                          double refresh_hz) {
    const int held = refreshes_per_frame(animation.frame_rate_hz, refresh_hz);
    if (held == 0) {
        throw InputError(
            fmt::format("a refresh rate of {} Hz is no whole multiple of the frame rate of {} Hz: "
                        "frames would be lit for unequal times",
                        refresh_hz, animation.frame_rate_hz));
    }
    PageCycle cycle;
    for (int step = 0; step < animation.steps_per_period(); ++step) {
        const AnimationFrameIndex frame = animation.frame_at_step(step);
        cycle.entry_of_refresh.insert(cycle.entry_of_refresh.end(), static_cast<std::size_t>(held),
                                      static_cast<std::uint16_t>(cycle.entries.size()));
        cycle.entries.push_back({frame, pose_of_frame[static_cast<std::size_t>(frame.value)], held});
    }
    cycle.total_refreshes = held * animation.shown_frame_count();
    return cycle;
}

PageCycle make_page_cycle(const Animation& animation, double refresh_hz) {
    return make_page_cycle(animation, distinct_poses(animation).frames_of(0), refresh_hz);
}

} // namespace overt
