#include <algorithm>

#include <fmt/format.h>

#include "experiment/base/counted.h"
#include "experiment/base/error.h"
#include "experiment/checks/protocol_checks.h"
#include "experiment/design/observer_groups.h"
#include "experiment/design/recorded_trials.h"
#include "experiment/design/schedule.h"

namespace overt {

namespace {

/// Keys of [[motion]] that say nothing of what was recorded.
constexpr std::string_view keys_of_other_ways[] = {"frame_count",         "amplitude_deg", "angle_deg",
                                                   "light_amplitude_deg", "light_turns",   "playback"};

class RecordedMotionChecks {
  public:
    RecordedMotionChecks(ProtocolExamination& examination, std::size_t motion)
        : examination_(examination), motion_(examination.protocol.motions[motion]), number_(motion) {}

    void run() {
        for (const std::string_view name : keys_of_other_ways)
            if (examination_.is_written(key(name)))
                examination_.error({key(name), key("kind")},
                                   fmt::format("\"{}\" says nothing of a motion that was recorded", name),
                                   "leave it out; the tables say how the object stands, and when");
        if (motion_.recorded.empty())
            examination_.error({key("recorded"), key("kind")},
                               "a motion of kind \"recorded\" needs the tables of what was recorded",
                               "recorded = [\"P01_courses.tsv\"]: courses.tsv of overt export --format tsv");
        if (motion_.courses.empty())
            return;
        const auto [shortest, longest] = std::ranges::minmax(motion_.courses, {}, &RecordedCourse::lasts_s);
        if (examination_.is_written(key("duration_s")))
            compare(key("duration_s"), motion_.duration_s, shortest.lasts_s, longest.lasts_s);
        const std::vector<Task>& tasks = examination_.protocol.tasks;
        for (std::size_t task = 0; task < tasks.size(); ++task)
            if (!tasks[task].trials.procedures.empty() && motion_.matched_by == CourseMatch::stimulus)
                examination_.warning(
                    {key("matched_by"), key("recorded")},
                    fmt::format("a procedure chooses the stimuli of task {} when their trials come: \"{}\" "
                                "is matched by the stimuli that were planned",
                                tasks[task].id, motion_.id),
                    "matched_by = \"trial\" goes by the number of the trial");
        for (std::size_t task = 0; task < tasks.size(); ++task)
            for (const StepSettings& step : tasks[task].steps)
                if (step.kind == StepKind::show && step.duration && !step.ends_by_answer && !step.frame)
                    compare(fmt::format("task[{}].steps", task), step.duration->longest_s(), shortest.lasts_s,
                            longest.lasts_s);
    }

  private:
    std::string key(std::string_view name) const { return fmt::format("motion[{}].{}", number_, name); }

    /// Told once for each motion: shows that last otherwise than what they show again.
    void compare(const std::string& path, double shown_s, double shortest_s, double longest_s) {
        const double refresh_s = 1.0 / examination_.protocol.display.refresh_hz;
        if (is_told_ || (shown_s > longest_s - 1.5 * refresh_s && shown_s < shortest_s + 1.5 * refresh_s))
            return;
        is_told_ = true;
        examination_.warning(
            {path},
            fmt::format("\"{}\" is shown for {:g} s, and was recorded for {:.3f} … {:.3f} s: what is longer "
                        "is cut off, what is shorter stands in its last pose",
                        motion_.id, shown_s, shortest_s, longest_s));
    }

    ProtocolExamination& examination_;
    const MotionSettings& motion_;
    std::size_t number_;
    bool is_told_ = false;
};

} // namespace

void check_recorded_motions(ProtocolExamination& examination) {
    for (std::size_t i = 0; i < examination.protocol.motions.size(); ++i)
        if (examination.protocol.motions[i].kind == MotionKind::recorded)
            RecordedMotionChecks(examination, i).run();
}

void check_yoked_trials(ProtocolExamination& examination) {
    const Protocol& protocol = examination.protocol;
    std::vector<std::string> paths;
    std::size_t recorded = 0;
    for (std::size_t i = 0; i < protocol.motions.size(); ++i)
        if (protocol.motions[i].kind == MotionKind::recorded) {
            paths.push_back(fmt::format("motion[{}].recorded", i));
            recorded = std::max(recorded, whose_courses(protocol.motions[i].courses).size());
        }
    int observers = std::max(protocol.schedule.observers, static_cast<int>(recorded));
    if (const auto capacity = group_capacity(protocol))
        observers = std::min(observers, *capacity);
    for (int number = 1; !paths.empty() && number <= observers; ++number) {
        std::vector<Trial> trials = trials_of(protocol, number);
        // Which trial has which number is known of the ordered schedule alone; where all trials are shown
        // again it makes no difference.
        const bool goes_by_number = std::ranges::any_of(protocol.motions, [](const MotionSettings& motion) {
            return motion.kind == MotionKind::recorded && motion.matched_by == CourseMatch::trial;
        });
        if (goes_by_number &&
            !std::ranges::all_of(trials, [&](const Trial& trial) { return is_yoked(protocol, trial); }))
            continue;
        if (std::optional<std::string> wrong = yoke(protocol, number, trials))
            return examination.error(
                paths, fmt::format("{} (observer {})", *wrong, number),
                "record it, show what was recorded, or name other tables; matched_by says which trials "
                "are alike");
    }
}

} // namespace overt
