#include "experiment/motion_words.h"

#include <cmath>
#include <string_view>

#include <fmt/format.h>

namespace overt {

namespace {

std::string times_round(int turns) {
    const int times = std::abs(turns);
    const std::string_view direction = turns < 0 ? "clockwise" : "counter-clockwise";
    return times == 1 ? fmt::format("once all the way round, {}", direction)
                      : fmt::format("{} times all the way round, {}", times, direction);
}

} // namespace

std::string way_of(const Animation& motion) {
    const std::string_view eased = motion.ease == MotionEase::none ? "at one speed" : "with eased ends";
    switch (motion.kind) {
    case MotionKind::turn:
        return fmt::format("{} deg to each side", motion.amplitude.value);
    case MotionKind::still:
        return "still";
    case MotionKind::observer:
        return "as the observer turns it";
    case MotionKind::turntable:
        return times_round(motion.turns);
    case MotionKind::triangle:
        return fmt::format("{} deg to each side, {}", motion.amplitude.value, eased);
    case MotionKind::trapezoid:
        return fmt::format("{} deg to each side, {}, at rest for {:.0f} % of the time",
                           motion.amplitude.value, eased, 100.0 * motion.rest_share);
    case MotionKind::steps:
        return "at one angle after the other";
    case MotionKind::waves:
        return "to and fro as a sum of sines";
    case MotionKind::orbit:
        return "the camera " + times_round(motion.turns);
    case MotionKind::approach:
        return motion.playback == Playback::cycle ? fmt::format("nearer by {} and back", motion.approach)
                                                  : fmt::format("nearer by {}", motion.approach);
    case MotionKind::keyframes:
        return "from place to place by a table";
    case MotionKind::recorded:
        return "as observers of earlier sessions turned it";
    case MotionKind::movie:
        return fmt::format("a movie of {} pictures", motion.frame_count);
    }
    return {};
}

std::string way_of_light(const Animation& motion) {
    std::string words;
    if (motion.light_amplitude.value != 0.0)
        words = fmt::format("{} deg to each side", motion.light_amplitude.value);
    if (motion.light_turns != 0)
        words += (words.empty() ? "" : " and ") + times_round(motion.light_turns);
    return words;
}

} // namespace overt
