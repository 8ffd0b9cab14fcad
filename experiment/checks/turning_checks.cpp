#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/answers/answer_kinds.h"
#include "experiment/checks/observer_keys.h"
#include "experiment/checks/protocol_checks.h"

namespace overt {

namespace {

/// Keys of [[motion]] that only what the observer turns has, and those that it has not.
constexpr std::string_view turning_keys[] = {"step_deg",
                                             "from_deg",
                                             "to_deg",
                                             "start",
                                             "with",
                                             "keys",
                                             "speed_deg_s",
                                             "drag_deg",
                                             "simulated_turn_deg",
                                             "simulated_pause_s",
                                             "elevation_step_deg",
                                             "elevation_from_deg",
                                             "elevation_to_deg"};
constexpr std::string_view idle_keys[] = {"frame_count", "amplitude_deg", "light_amplitude_deg",
                                          "light_turns", "playback"};

class TurningChecks {
  public:
    TurningChecks(ProtocolExamination& examination, std::size_t motion)
        : examination_(examination), motion_(examination.protocol.motions[motion]), number_(motion) {}

    void run() {
        if (motion_.kind != MotionKind::observer) {
            for (const std::string_view name : turning_keys)
                if (examination_.is_written(key(name)))
                    error({name}, fmt::format("\"{}\" is for a motion of kind \"observer\"", name),
                          "leave it out, or write kind = \"observer\"");
            return;
        }
        for (const std::string_view name : idle_keys)
            if (examination_.is_written(key(name)))
                error({name}, fmt::format("\"{}\" says nothing of what the observer turns", name),
                      "leave it out; step_deg, from_deg and to_deg say which poses there are");
        check_range();
        check_elevations();
        check_keys();
        for (std::size_t task = 0; task < examination_.protocol.tasks.size(); ++task)
            check_task(task);
    }

  private:
    const ObserverTurn& by() const { return motion_.by_observer; }
    std::string key(std::string_view name) const { return fmt::format("motion[{}].{}", number_, name); }
    void error(const std::vector<std::string_view>& names, std::string message, std::string hint = {}) {
        std::vector<std::string> paths;
        for (const std::string_view name : names)
            paths.push_back(key(name));
        paths.push_back(key("kind"));
        examination_.error(paths, std::move(message), std::move(hint));
    }

    void check_range() {
        const double range_deg = by().to.value - by().from.value;
        const double steps = range_deg / by().step.value;
        if (range_deg <= 0.0 || range_deg > 360.0 + 1e-9) {
            error({"to_deg", "from_deg"},
                  fmt::format("it can be turned from {:g} to {:g} deg", by().from.value, by().to.value),
                  "to_deg is larger than from_deg, by 360 at most, which is all round");
            return;
        }
        if (std::abs(steps - std::round(steps)) > 1e-6)
            error({"step_deg", "to_deg", "from_deg"},
                  fmt::format("from {:g} to {:g} deg are {:.6g} steps of {:g} deg, which is no whole number",
                              by().from.value, by().to.value, steps, by().step.value),
                  fmt::format("step_deg = {:.6g} or {:.6g} would do", range_deg / std::ceil(steps),
                              range_deg / std::max(1.0, std::floor(steps))));
        if (!by().is_whole() && examination_.is_written(key("angle_deg")) &&
            (motion_.angle.value < by().from.value || motion_.angle.value > by().to.value))
            error({"angle_deg"}, fmt::format("it comes up at {:g} deg, and can be turned from {:g} to {:g}",
                                             motion_.angle.value, by().from.value, by().to.value));
    }

    void check_elevations() {
        if (!by().has_elevations()) {
            for (const std::string_view name : {"elevation_from_deg", "elevation_to_deg"})
                if (examination_.is_written(key(name)))
                    error({name},
                          fmt::format("\"{}\" says how far it is tilted, and nothing in which steps", name),
                          "write elevation_step_deg, or leave it out");
            return;
        }
        const double range_deg = by().elevation_to.value - by().elevation_from.value;
        const double steps = range_deg / by().elevation_step.value;
        if (range_deg <= 0.0)
            error({"elevation_to_deg", "elevation_from_deg", "elevation_step_deg"},
                  fmt::format("it can be tilted from {:g} to {:g} deg", by().elevation_from.value,
                              by().elevation_to.value),
                  "elevation_to_deg is larger than elevation_from_deg");
        else if (std::abs(steps - std::round(steps)) > 1e-6)
            error({"elevation_step_deg", "elevation_to_deg", "elevation_from_deg"},
                  fmt::format("from {:g} to {:g} deg are {:.6g} steps of {:g} deg, which is no whole number",
                              by().elevation_from.value, by().elevation_to.value, steps,
                              by().elevation_step.value),
                  fmt::format("elevation_step_deg = {:.6g} or {:.6g} would do", range_deg / std::ceil(steps),
                              range_deg / std::max(1.0, std::floor(steps))));
        if (by().pose_count() != motion_.frame_count)
            error({"elevation_step_deg", "step_deg"},
                  fmt::format("{} turns at {} elevations are {} poses, and a motion has up to {}",
                              by().turn_count(), by().elevation_count(), by().pose_count(),
                              motion_.frame_count),
                  "take longer steps, or turn it less far");
    }

    void check_keys() {
        const std::size_t count = by().has_elevations() ? 4 : 2;
        std::vector<std::string> differ = by().keys;
        std::ranges::sort(differ);
        if (differ.size() != count || std::ranges::adjacent_find(differ) != differ.end())
            error({"keys"},
                  count == 2 ? "an object is turned with two keys"
                             : "an object is turned and tilted with four keys",
                  count == 2 ? "write keys = [\"left\", \"right\"]"
                             : "write keys = [\"left\", \"right\", \"up\", \"down\"]");
        if (by().with == TurnedWith::mouse && examination_.is_written(key("keys")))
            error({"keys"}, "the keys turn nothing with \"with = mouse\"",
                  "write with = \"keys\" or \"keys-and-mouse\"");
        for (const std::string& name : by().keys)
            if (KeyFault fault = fault_of_observer_key(examination_.protocol, name); !fault.message.empty())
                error({"keys"}, std::move(fault.message), std::move(fault.hint));
    }

    /// What inputs do besides, in tasks that may show it.
    void check_task(std::size_t index) {
        const Task& task = examination_.protocol.tasks[index];
        const auto shows = [](const StepSettings& step) { return step.kind == StepKind::show; };
        if (std::ranges::any_of(task.steps, [&](const StepSettings& step) {
                return shows(step) && step.ends_by_key && !step.frame;
            }))
            examination_.error(
                {fmt::format("task[{}].steps", index)},
                fmt::format("any key ends a step that shows stimuli, and \"{}\" is turned meanwhile",
                            motion_.id),
                "end it by an answer of kind \"key\": until = \"answer\"");
        const bool waits = std::ranges::any_of(
            task.steps, [&](const StepSettings& step) { return shows(step) && step.ends_by_answer; });
        for (std::size_t i = 0; waits && i < task.answers.size(); ++i) {
            const TaskAnswer& answer = task.answers[i];
            if (!row_of(answer.kind).is_given_unseen)
                continue;
            const std::string path = fmt::format("task[{}].answer[{}]", index, i);
            if (by().with != TurnedWith::keys &&
                (answer.with != AnsweredWith::keys || name_of(answer.kind) == "point" ||
                 name_of(answer.kind) == "gauge"))
                examination_.error({path + ".with", path + ".kind"},
                                   fmt::format("the mouse answers \"{}\", and turns what moves as \"{}\"",
                                               answer.id, motion_.id),
                                   "have one of them with keys");
            std::vector<std::string> keys =
                row_of(answer.kind).has_key("along") ? answer.match_keys() : answer.keys;
            if (row_of(answer.kind).has_key("along"))
                std::ranges::copy(answer.match_coarse_keys(), std::back_inserter(keys));
            if (answer.accepts_by_key())
                keys.push_back(answer.accept_key);
            for (const std::string& name : keys)
                if (by().with != TurnedWith::mouse && answer.with != AnsweredWith::mouse &&
                    std::ranges::find(by().keys, name) != by().keys.end())
                    examination_.error({path + ".keys", path + ".kind"},
                                       fmt::format("the key \"{}\" answers \"{}\", and turns what moves as "
                                                   "\"{}\"",
                                                   name, answer.id, motion_.id),
                                       "take other keys for one of them");
        }
    }

    ProtocolExamination& examination_;
    const MotionSettings& motion_;
    std::size_t number_;
};

} // namespace

void check_turning(ProtocolExamination& examination) {
    for (std::size_t motion = 0; motion < examination.protocol.motions.size(); ++motion)
        TurningChecks(examination, motion).run();
}

} // namespace overt
