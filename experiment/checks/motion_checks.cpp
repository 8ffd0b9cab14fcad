#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "experiment/checks/protocol_checks.h"

namespace overt {

namespace {

/// Keys of [[motion]] that are of some kinds alone.
constexpr std::string_view keys_of_kinds[] = {
    "amplitude_deg", "turns",       "axis",      "pivot",   "rest_share", "ease",      "angles_deg",
    "waves",         "approach_mm", "keyframes", "between", "recorded",   "matched_by"};

class MotionKindChecks {
  public:
    MotionKindChecks(ProtocolExamination& examination, std::size_t number)
        : examination_(examination), motion_(examination.protocol.motions[number]), number_(number) {}

    void run() {
        const MotionKindRow& row = row_of(motion_.kind);
        for (const std::string_view name : keys_of_kinds)
            if (examination_.is_written(key(name)) && !row.has_key(name) &&
                motion_.kind != MotionKind::observer)
                examination_.warning(
                    {key(name), key("kind")},
                    fmt::format("\"{}\" has no effect on a motion of kind \"{}\"", name, row.name));
        check_kind();
        if (motion_.axis && glm::length(*motion_.axis) == 0.0)
            error({"axis"}, "an axis of length 0 points nowhere");
        if (motion_.light_turns != 0 && motion_.playback == Playback::ping_pong)
            examination_.warning({key("light_turns"), key("playback")},
                                 "with playback = \"ping-pong\" the light goes round and back again",
                                 "with \"cycle\" it goes on the same way");
        check_given_maps();
    }

  private:
    std::string key(std::string_view name) const { return fmt::format("motion[{}].{}", number_, name); }
    void error(const std::vector<std::string_view>& names, std::string message, std::string hint = {}) {
        std::vector<std::string> paths;
        for (const std::string_view name : names)
            paths.push_back(key(name));
        paths.push_back(key("kind"));
        examination_.error(paths, std::move(message), std::move(hint));
    }

    void check_kind() {
        switch (motion_.kind) {
        case MotionKind::turntable:
        case MotionKind::orbit:
            if (motion_.turns == 0)
                error({"turns"}, "no turn at all: turns is 0", "write kind = \"still\"");
            break;
        case MotionKind::steps:
            check_steps();
            break;
        case MotionKind::waves:
            check_waves();
            break;
        case MotionKind::approach:
            if (motion_.approach == 0.0)
                error({"approach_mm"}, "\"approach_mm\" says how far the object comes nearer, and is 0");
            break;
        case MotionKind::keyframes:
            if (motion_.keyframes.empty())
                error({"keyframes"}, "a motion of kind \"keyframes\" needs the table of its places",
                      "keyframes = \"way.csv\"");
            else if (examination_.is_written(key("light_amplitude_deg")) ||
                     examination_.is_written(key("light_turns")))
                error({"light_amplitude_deg", "light_turns"},
                      "the table of places says how the light stands, in its column light_deg");
            break;
        default:
            break;
        }
    }

    void check_steps() {
        const int count = static_cast<int>(motion_.angles_deg.size()), intervals = motion_.frame_count - 1;
        if (count == 0)
            return error({"angles_deg"}, "a motion of kind \"steps\" needs the angles where it stands",
                         "angles_deg = [-20, 0, 20]");
        if (intervals % count != 0 || intervals == 0)
            error({"angles_deg", "frame_count"},
                  fmt::format(
                      "{} frames, of which the last is the first again, are not divided evenly among {} "
                      "angles",
                      motion_.frame_count, count),
                  fmt::format("frame_count = {} or {}", std::max(1, intervals / count) * count + 1,
                              (intervals / count + 1) * count + 1));
    }

    void check_waves() {
        if (motion_.waves.empty())
            error({"waves"}, "a motion of kind \"waves\" needs at least one sine",
                  "waves = [[20, 1, 0]]: amplitude in degrees, periods, phase in degrees");
        for (const auto& wave : motion_.waves)
            if (wave[1] != std::round(wave[1]) || wave[1] < 1.0)
                error({"waves"},
                      fmt::format("a sine of {} periods in all frames does not close the loop", wave[1]),
                      "write a whole number of periods, from 1 on");
        if (motion_.playback == Playback::ping_pong)
            error({"playback"}, "a sum of sines closes a loop: it is played as \"cycle\"");
    }

    /// Maps that another program made say of turns about the vertical alone.
    void check_given_maps() {
        const std::vector<ObjectSettings>& objects = examination_.protocol.objects;
        const auto given = std::ranges::find_if(objects, [](const auto& one) { return !one.lut.empty(); });
        if (given != objects.end() && !motion_.only_turns())
            error(
                {"axis", "pivot", "approach_mm", "keyframes"},
                fmt::format("object \"{}\" has ready-made maps, which are of turns about the vertical alone",
                            given->id),
                "give its mesh, or let it turn about the vertical through its centre");
    }

    ProtocolExamination& examination_;
    const Animation& motion_;
    std::size_t number_;
};

} // namespace

void check_motion_kinds(ProtocolExamination& examination) {
    for (std::size_t i = 0; i < examination.protocol.motions.size(); ++i)
        MotionKindChecks(examination, i).run();
}

} // namespace overt
