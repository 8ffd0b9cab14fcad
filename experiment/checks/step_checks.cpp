#include "experiment/checks/protocol_checks.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/design/trial_plan.h"

namespace overt {

namespace {

/// Of one task.
class StepChecks {
  public:
    StepChecks(ProtocolExamination& examination, const Task& task)
        : examination_(examination), task_(task), watched_(watched_steps(task.steps)),
          slots_(slots_of_task(examination.protocol,
                               static_cast<int>(&task - examination.protocol.tasks.data()))) {}

    void run() {
        check_ids();
        check_order();
        for (std::size_t i = 0; i < task_.steps.size(); ++i) {
            check_end(task_.steps[i]);
            check_place(task_.steps[i]);
            if (task_.steps[i].gaze)
                check_gaze(task_.steps[i], watched_[i]);
        }
    }

  private:
    void error(Place place, std::string message, std::string hint = {}) {
        examination_.diagnostics().error(examination_.protocol.file.string(), place, std::move(message),
                                         std::move(hint));
    }

    void check_ids() {
        std::map<std::string, Place> known;
        for (const StepSettings& step : task_.steps) {
            if (step.id.empty())
                continue;
            const auto [same, is_new] = known.emplace(step.id, step.id_place);
            if (!is_new)
                error(
                    step.id_place,
                    fmt::format("step id \"{}\" is used twice, first in line {}", step.id, same->second.line),
                    "the record tells steps by their ids: give each its own");
        }
    }

    void check_order() {
        int answers = 0, spoken = 0;
        for (const StepSettings& step : task_.steps) {
            answers += step.kind == StepKind::answer || step.ends_by_answer ? 1 : 0;
            if (step.kind == StepKind::answer && step.answers.empty() && ++spoken == 2)
                error(step.place, fmt::format("task {} takes a spoken answer a second time", task_.id),
                      "a trial has one spoken answer");
            if (step.kind == StepKind::feedback && answers == 0)
                error(step.place, "there is no answer yet that feedback could be about",
                      "put the feedback behind the step answer");
        }
        check_all_are_shown();
    }

    void check_end(const StepSettings& step) {
        const bool ends = step.duration || step.ends_by_key || step.ends_by_answer ||
                          (step.gaze && step.gaze->patience_s) || step.kind == StepKind::text ||
                          step.kind == StepKind::show || step.kind == StepKind::answer ||
                          step.kind == StepKind::drift_check;
        if (ends)
            return;
        if (step.gaze)
            error(step.place, "this step never ends for an observer who does not look there",
                  "add patience_s to until, or for_s to the step");
        else
            error(step.place, fmt::format("this step {} never ends", name_of(step.kind)),
                  "add for_s, in seconds");
    }

    void check_place(const StepSettings& step) {
        if (step.kind == StepKind::show)
            check_slots(step);
        for (const MotionSettings& motion : examination_.protocol.motions)
            if (step.frame && *step.frame >= motion.frame_count) {
                error(step.frame_place, fmt::format("frame: there is no frame {}", *step.frame),
                      fmt::format("the motion has frames 0 to {}", motion.frame_count - 1));
                return;
            }
    }

    const std::string& slot_id(int slot) const {
        return examination_.protocol.slots[static_cast<std::size_t>(slot)].id;
    }
    std::vector<std::string> ids_of_slots(const std::vector<int>& slots) const {
        std::vector<std::string> ids;
        for (const int slot : slots)
            ids.push_back(slot_id(slot));
        return ids;
    }
    bool is_shown_by_task(int slot) const { return std::ranges::find(slots_, slot) != slots_.end(); }

    /// Whether names are of slots, or of circles and grids of them, and of the task's.
    bool check_slot_names(const std::vector<std::string>& names, Place place) {
        const int errors = examination_.diagnostics().error_count();
        for (const std::string& name : names) {
            const std::vector<int> slots = slots_named(examination_.protocol, {name});
            if (slots.empty())
                error(
                    place, fmt::format("unknown slot \"{}\"", name),
                    fmt::format("slots of task {} are {}", task_.id, fmt::join(ids_of_slots(slots_), ", ")));
            else if (!std::ranges::all_of(slots, [&](int slot) { return is_shown_by_task(slot); }))
                error(place,
                      fmt::format("task {} shows stimuli in {}, and this step in {}", task_.id,
                                  fmt::join(ids_of_slots(slots_), ", "), name),
                      "add it to `slots` of the task, or show another");
        }
        return examination_.diagnostics().error_count() == errors;
    }

    /// A step shows some of the task's slots, or all.
    void check_slots(const StepSettings& step) {
        if (check_slot_names(step.slots, step.place))
            check_slots_apart(examination_, step.place, slots_named(examination_.protocol, step.slots));
    }

    /// Each slot of the task is shown by a step.
    void check_all_are_shown() {
        std::vector<int> missing = slots_;
        const StepSettings* last = nullptr;
        bool are_known = true;
        for (const StepSettings& step : task_.steps)
            if (step.kind == StepKind::show) {
                last = &step;
                const std::vector<int> shown = slots_named(examination_.protocol, step.slots);
                for (const std::string& name : step.slots)
                    are_known = are_known && !slots_named(examination_.protocol, {name}).empty();
                std::erase_if(missing,
                              [&](int slot) { return std::ranges::find(shown, slot) != shown.end(); });
            }
        if (!last)
            error(task_.steps.front().place, fmt::format("no step of task {} shows the stimulus", task_.id),
                  "add { show = \"centre\" }");
        else if (are_known && !missing.empty())
            error(last->place,
                  fmt::format("no step of task {} shows its slot{} {}", task_.id,
                              missing.size() > 1 ? "s" : "", fmt::join(ids_of_slots(missing), ", ")),
                  "name them in a step show, or leave them out of `slots` of the task");
    }

    void check_gaze(const StepSettings& step, bool is_watched) {
        if (!is_watched)
            error(step.place, "no gaze is recorded during this step",
                  "gaze is recorded from the step show on, and in the steps fixation, blank and mask that "
                  "stand directly before and after it");
        if (!step.gaze->area.empty() && step.kind != StepKind::show)
            error(step.gaze->area_place,
                  fmt::format("a step {} shows no {}", name_of(step.kind), step.gaze->area),
                  "gaze on an area of the object can end the step show");
        check_gaze_slot(step);
        if (step.gaze->otherwise == GazeMissed::drift_check && step.kind == StepKind::show)
            error(step.place, "a step that shows the stimulus cannot begin anew after a drift check",
                  "write otherwise = \"abort\" or \"continue\", or wait for gaze in a fixation before it");
    }

    /// Gaze is waited for in a slot: on its object while the step shows it, or around its middle.
    void check_gaze_slot(const StepSettings& step) {
        const GazeWait& wait = *step.gaze;
        if (wait.slot.empty())
            return;
        const std::vector<int> slots = slots_named(examination_.protocol, {wait.slot});
        if (slots.empty()) {
            check_slot_names({wait.slot}, wait.slot_place);
            return;
        }
        if (wait.area.empty() && slots.size() > 1) {
            error(wait.slot_place, fmt::format("slot: \"{}\" is {} places", wait.slot, slots.size()),
                  fmt::format("name one, such as {}", slot_id(slots.front())));
            return;
        }
        const std::vector<int> shown = slots_named(examination_.protocol, step.slots);
        const bool is_shown = std::ranges::any_of(
            slots, [&](int slot) { return std::ranges::find(shown, slot) != shown.end(); });
        if (!wait.area.empty() && step.kind == StepKind::show && !is_shown)
            error(wait.slot_place, fmt::format("this step shows nothing in slot {}", wait.slot),
                  fmt::format("it shows {}", fmt::join(ids_of_slots(shown), ", ")));
    }

    ProtocolExamination& examination_;
    const Task& task_;
    std::vector<bool> watched_;
    std::vector<int> slots_; ///< of the task
};

} // namespace

void check_steps(ProtocolExamination& examination) {
    const std::vector<Task>& tasks = examination.protocol.tasks;
    for (std::size_t i = 0; i < tasks.size(); ++i)
        if (!tasks[i].steps.empty() && !examination.faulty.contains(fmt::format("task[{}].steps", i)))
            StepChecks(examination, tasks[i]).run();
}

} // namespace overt
