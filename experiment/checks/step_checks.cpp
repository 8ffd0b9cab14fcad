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
        : examination_(examination), task_(task), watched_(watched_steps(task.steps)) {}

    void run() {
        check_ids();
        check_order();
        for (std::size_t i = 0; i < task_.steps.size(); ++i) {
            check_end(task_.steps[i]);
            check_place(task_.steps[i]);
            if (task_.steps[i].gaze)
                check_gaze(task_.steps[i], i >= watched_.begin && i < watched_.end);
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
        int shows = 0, answers = 0, spoken = 0;
        for (const StepSettings& step : task_.steps) {
            if (step.kind == StepKind::show && ++shows == 2)
                error(step.place, fmt::format("task {} shows its stimulus a second time", task_.id),
                      "a trial has one step that shows; make the other a trial of its own");
            answers += step.kind == StepKind::answer || step.ends_by_answer ? 1 : 0;
            if (step.kind == StepKind::answer && step.answers.empty() && ++spoken == 2)
                error(step.place, fmt::format("task {} takes a spoken answer a second time", task_.id),
                      "a trial has one spoken answer");
            if (step.kind == StepKind::feedback && answers == 0)
                error(step.place, "there is no answer yet that feedback could be about",
                      "put the feedback behind the step answer");
        }
        if (shows == 0)
            error(task_.steps.front().place, fmt::format("no step of task {} shows the stimulus", task_.id),
                  "add { show = \"centre\" }");
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

    /// A step shows all that the trial has: what it names are the task's slots.
    void check_slots(const StepSettings& step) {
        const Protocol& protocol = examination_.protocol;
        std::vector<std::string> all, shown;
        for (const Slot& slot : protocol.slots)
            all.push_back(slot.id);
        for (const int slot : slots_of_task(protocol, static_cast<int>(&task_ - protocol.tasks.data())))
            shown.push_back(all[static_cast<std::size_t>(slot)]);
        const auto entry_of = [&](const std::string& id) -> std::string {
            for (const Slot& slot : protocol.slots)
                if (slot.id == id && slot.entry >= 0)
                    return protocol.slot_entries[static_cast<std::size_t>(slot.entry)].id;
            return id;
        };
        bool is_known = true;
        for (const std::string& slot : step.slots) {
            const auto is_it = [&](const std::string& id) { return slot == id || slot == entry_of(id); };
            if (std::ranges::any_of(all, is_it))
                continue;
            is_known = false;
            error(step.place, fmt::format("unknown slot \"{}\"", slot),
                  fmt::format("slots are {}", fmt::join(all, ", ")));
        }
        const auto is_named = [&](const std::string& id) {
            return std::ranges::any_of(
                step.slots, [&](const std::string& slot) { return slot == id || slot == entry_of(id); });
        };
        const bool is_all = std::ranges::all_of(all, [&](const std::string& id) {
            return is_named(id) == (std::ranges::find(shown, id) != shown.end());
        });
        if (is_known && !is_all)
            error(step.place,
                  fmt::format("task {} shows stimuli in {}, and this step in {}", task_.id,
                              fmt::join(shown, ", "), fmt::join(step.slots, ", ")),
                  "a step shows all slots of its task: name them here, or change `slots` of the task");
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
        if (step.gaze->otherwise == GazeMissed::drift_check && step.kind == StepKind::show)
            error(step.place, "a step that shows the stimulus cannot begin anew after a drift check",
                  "write otherwise = \"abort\" or \"continue\", or wait for gaze in a fixation before it");
    }

    ProtocolExamination& examination_;
    const Task& task_;
    WatchedSteps watched_;
};

} // namespace

void check_steps(ProtocolExamination& examination) {
    const std::vector<Task>& tasks = examination.protocol.tasks;
    for (std::size_t i = 0; i < tasks.size(); ++i)
        if (!tasks[i].steps.empty() && !examination.faulty.contains(fmt::format("task[{}].steps", i)))
            StepChecks(examination, tasks[i]).run();
}

} // namespace overt
