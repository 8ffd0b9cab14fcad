#include "experiment/animation.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/motion_phase.h"

namespace overt {

Pose Animation::pose_of(AnimationFrameIndex frame) const {
    OVERT_EXPECTS(frame.value >= 0 && frame.value < frame_count);
    if (!given.empty())
        return given.at(static_cast<std::size_t>(frame.value));
    Pose pose = law_of(kind).pose_of(*this, frame);
    if (light_amplitude.value != 0.0)
        pose.light.value += light_amplitude.value * sine_of(*this, frame);
    if (light_turns != 0)
        pose.light.value = within_half_turn(pose.light.value + full_turns_of(*this, frame, light_turns));
    return pose;
}

bool Animation::moves() const {
    return law_of(kind).moves || light_amplitude.value != 0.0 || light_turns != 0;
}

const MotionLaw& law_of(MotionKind kind) {
    static const auto laws = for_each_kind<MotionKind>([]<MotionKind of>() { return &motion_law<of>(); });
    return *laws.at(static_cast<std::size_t>(kind));
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
    const auto from_front = [](Degrees turn) { return std::abs(std::remainder(turn.value, 360.0)); };
    if (kind == MotionKind::turn || kind == MotionKind::still) {
        const bool turns_about_vertical =
            kind == MotionKind::turn && (!axis || (axis->x == 0.0 && axis->y == 0.0));
        const double turn = turns_about_vertical ? std::abs(amplitude.value) : 0.0;
        return {std::min(from_front(angle) + turn, 180.0)};
    }
    double largest = 0.0;
    for (int frame = 0; frame < frame_count; ++frame)
        largest = std::max(largest, from_front(angle_of({frame})));
    return {largest};
}

bool Animation::turns_light() const {
    if (kind == MotionKind::movie)
        return false;
    for (int frame = 0; frame < frame_count; ++frame) {
        if (pose_of({frame}).light.value != 0.0)
            return true;
    }
    return false;
}

bool Animation::only_turns() const {
    for (int frame = 0; frame < frame_count; ++frame) {
        if (!object_in({frame}).is_turn())
            return false;
    }
    return true;
}

int Animation::shown_frame_count() const { return static_cast<int>(std::lround(duration_s * frame_rate_hz)); }

int Animation::steps_per_period() const {
    if (!has_plan())
        return frame_count;
    // Of a movie that begins again no picture is another once more.
    if (kind == MotionKind::movie && playback == Playback::cycle)
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
    if (!has_plan())
        return {in_period};
    // The closing frame of a cycle is the first of the next.
    return {in_period <= intervals ? in_period : 2 * intervals - in_period};
}

void PoseTable::add(const Animation& motion) {
    std::vector<PoseIndex>& poses = of_motion.emplace_back();
    for (int frame = 0; frame < motion.frame_count; ++frame) {
        const ObjectPose object = motion.object_in({frame});
        auto known = std::ranges::find_if(
            angles, [&](const ObjectPose& one) { return is_same_object_pose(one, object); });
        if (known == angles.end())
            known = angles.insert(known, object);
        poses.push_back({static_cast<int>(known - angles.begin())});
    }
}

PoseIndex PoseTable::index_of(const ObjectPose& object) const {
    const auto found =
        std::ranges::find_if(angles, [&](const ObjectPose& one) { return is_same_object_pose(one, object); });
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
    if (!animation.has_plan()) {
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
    if (!animation.has_plan()) {
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
