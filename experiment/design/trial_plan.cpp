#include "experiment/design/trial_plan.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/answers/answer_kinds.h"
#include "experiment/base/counted.h"
#include "experiment/base/random.h"
#include "experiment/base/text_number.h"
#include "experiment/factors.h"
#include "experiment/protocol/all_stimuli.h"

namespace overt {

int refreshes_in(double seconds, double refresh_hz) {
    return std::max(1, static_cast<int>(std::lround(seconds * refresh_hz)));
}

double drawn_s(const StepDuration& duration, double u) {
    switch (duration.law) {
    case StepDuration::Law::uniform:
        return duration.from_s + u * (duration.to_s - duration.from_s);
    case StepDuration::Law::exponential: {
        const double tau = time_constant_s(duration.from_s, duration.to_s, duration.mean_s);
        return duration.from_s - tau * std::log1p(u * std::expm1(-(duration.to_s - duration.from_s) / tau));
    }
    case StepDuration::Law::fixed:
    case StepDuration::Law::one_of:
        break;
    }
    const auto count = static_cast<double>(duration.choices_s.size());
    return duration.choices_s[static_cast<std::size_t>(u * count)];
}

std::vector<bool> watched_steps(const std::vector<StepSettings>& steps) {
    std::vector<bool> watched(steps.size());
    const auto may_be = [&](std::size_t i) { return row_of(steps[i].kind).may_be_watched; };
    for (std::size_t begin = 0, end = 0; begin < steps.size(); begin = end + 1) {
        bool shows = false;
        for (end = begin; end < steps.size() && may_be(end); ++end)
            shows = shows || steps[end].kind == StepKind::show;
        for (std::size_t i = begin; i < end; ++i)
            watched[i] = shows;
    }
    return watched;
}

std::vector<int> places_shown(const Protocol& protocol, const StepSettings& step, const Trial& trial) {
    const std::vector<int> slots = slots_named(protocol, step.slots);
    std::vector<int> places;
    for (std::size_t i = 0; i < trial.shown_count(); ++i)
        if (std::ranges::find(slots, trial.shown(i).slot) != slots.end())
            places.push_back(static_cast<int>(i));
    return places;
}

namespace {

/// Indices of the answers with these ids that are given by inputs; of a step that names none, of all.
std::vector<int> answers_called(const Task& task, const std::vector<std::string>& ids) {
    std::vector<int> answers;
    const auto add = [&](std::size_t i) {
        if (row_of(task.answers[i].kind).make)
            answers.push_back(static_cast<int>(i));
    };
    for (std::size_t i = 0; ids.empty() && i < task.answers.size(); ++i)
        add(i);
    for (const std::string& id : ids)
        if (const auto found = std::ranges::find(task.answers, id, &TaskAnswer::id);
            found != task.answers.end())
            add(static_cast<std::size_t>(found - task.answers.begin()));
    return answers;
}

/// Gives each step that asks for answers, or waits for them, its sheet.
void plan_sheets(const Task& task, TrialPlan& plan) {
    const auto add_sheet = [&](const std::vector<std::string>& ids) {
        plan.sheets.push_back({.answers = answers_called(task, ids)});
        return static_cast<int>(plan.sheets.size()) - 1;
    };
    std::vector<std::size_t> waiting; ///< steps whose answers the next step `answer` asks for
    int shown_last = -1, ended_by_answer = -1;
    const auto close = [&](int sheet) {
        PlannedSheet& planned = plan.sheets[static_cast<std::size_t>(sheet)];
        planned.stimulus_step = ended_by_answer >= 0 ? ended_by_answer : shown_last;
        planned.waits_unseen = !waiting.empty();
        for (const std::size_t step : waiting)
            plan.steps[step].sheet = sheet;
        waiting.clear();
        ended_by_answer = -1;
    };
    for (std::size_t i = 0; i < plan.steps.size(); ++i) {
        PlannedStep& step = plan.steps[i];
        if (step.kind == StepKind::show)
            shown_last = static_cast<int>(i);
        if (step.ends_by_answer()) {
            waiting.push_back(i);
            if (step.kind == StepKind::show)
                ended_by_answer = static_cast<int>(i);
        }
        if (step.kind != StepKind::answer || task.answers.empty())
            continue;
        const bool is_spoken = step.settings && step.settings->answers.empty();
        const std::vector<std::string> ids = step.settings ? step.settings->answers : std::vector{step.id};
        if (is_spoken || answers_called(task, ids).empty())
            continue;
        step.sheet = add_sheet(ids);
        close(step.sheet);
    }
    if (!waiting.empty() && !answers_called(task, {}).empty())
        close(add_sheet({}));
}

TrialPlan plan_of_one_question(const Protocol& protocol, const Task& task, const Trial& trial) {
    const Stimulus& stimulus = trial.stimulus;
    TrialPlan plan;
    std::vector<StepKind> kinds{StepKind::text, StepKind::drift_check, StepKind::show};
    kinds.insert(kinds.end(), std::max<std::size_t>(1, task.answers.size()), StepKind::answer);
    for (const StepKind kind : kinds) {
        PlannedStep step;
        step.kind = kind;
        if (kind == StepKind::show) {
            step.drawn_s = protocol.motion_of(stimulus).duration_s;
            step.refreshes = page_cycles(protocol)[static_cast<std::size_t>(stimulus.motion)].total_refreshes;
            step.is_watched = true;
            for (std::size_t i = 0; i < trial.shown_count(); ++i)
                step.places.push_back(static_cast<int>(i));
        }
        const std::size_t asked = plan.steps.size() - 3;
        if (kind == StepKind::answer && asked < task.answers.size())
            step.id = task.answers[asked].id;
        plan.steps.push_back(std::move(step));
    }
    plan_sheets(task, plan);
    return plan;
}

} // namespace

namespace {

void place_masks(TrialPlan& plan) {
    std::vector<PlannedStep>& steps = plan.steps;
    const auto is_show = [](const PlannedStep& step) { return step.kind == StepKind::show; };
    for (auto step = steps.begin(); step != steps.end(); ++step) {
        if (step->kind != StepKind::mask)
            continue;
        const auto before = std::find_if(std::make_reverse_iterator(step), steps.rend(), is_show);
        const auto next = std::find_if(step, steps.end(), is_show);
        if (before != steps.rend())
            step->places = before->places;
        else if (next != steps.end())
            step->places = next->places;
    }
}

} // namespace

TrialPlan plan_trial(const Protocol& protocol, std::uint64_t seed, const Trial& trial, bool is_practice) {
    const Task& task = protocol.tasks[static_cast<std::size_t>(trial.task)];
    const std::vector<StepSettings>& steps = task.steps;
    if (steps.empty())
        return plan_of_one_question(protocol, task, trial);
    const double refresh_hz = protocol.display.refresh_hz;
    const std::vector<bool> watched = watched_steps(steps);
    TrialPlan plan;
    for (std::size_t i = 0; i < steps.size(); ++i) {
        const StepSettings& settings = steps[i];
        PlannedStep step;
        step.settings = &settings;
        step.kind = settings.kind;
        step.id = settings.id;
        step.is_watched = watched[i];
        if (settings.kind == StepKind::show) {
            step.places = places_shown(protocol, settings, trial);
            const std::size_t first = step.places.empty() ? 0 : static_cast<std::size_t>(step.places.front());
            step.drawn_s = protocol.motion_of(trial.shown(first).stimulus).duration_s;
        }
        if (settings.duration) {
            RandomStream stream(seed, fmt::format("{}step {}", is_practice ? "practice " : "", i),
                                static_cast<std::uint64_t>(trial.index));
            step.drawn_s = drawn_s(*settings.duration, stream.uniform());
        }
        if (const auto own_s = number_in<double>(own_level(trial, seconds_column(settings))))
            step.drawn_s = own_s;
        // What an answer ends goes on until then, or until nobody waits any longer.
        if (settings.ends_by_answer && !settings.duration)
            step.drawn_s = protocol.screens.response_max_s;
        if (step.drawn_s)
            step.refreshes = refreshes_in(*step.drawn_s, refresh_hz);
        if (settings.gaze && settings.gaze->patience_s)
            step.patience_refreshes = refreshes_in(*settings.gaze->patience_s, refresh_hz);
        plan.steps.push_back(std::move(step));
    }
    place_masks(plan);
    plan_sheets(task, plan);
    return plan;
}

namespace {

std::string seconds_and_refreshes(double seconds, double refresh_hz) {
    const int refreshes = refreshes_in(seconds, refresh_hz);
    return fmt::format("{:g} s ({}, {:.1f} ms)", seconds, counted(refreshes, "refresh", "refreshes"),
                       1e3 * refreshes / refresh_hz);
}

std::string duration_text(const StepDuration& duration, double refresh_hz) {
    const auto said = [&](double seconds) { return seconds_and_refreshes(seconds, refresh_hz); };
    switch (duration.law) {
    case StepDuration::Law::uniform:
        return fmt::format("{} to {}, drawn", said(duration.from_s), said(duration.to_s));
    case StepDuration::Law::exponential:
        return fmt::format("{} to {}, drawn exponentially with a mean of {:g} s", said(duration.from_s),
                           said(duration.to_s), duration.mean_s);
    case StepDuration::Law::fixed:
    case StepDuration::Law::one_of:
        break;
    }
    std::string text;
    for (const double one : duration.choices_s)
        text += fmt::format("{}{}", text.empty() ? "" : " or ", said(one));
    return duration.law == StepDuration::Law::one_of ? text + ", drawn" : text;
}

/// Each once.
StepDuration durations_of_motions(const Protocol& protocol) {
    StepDuration durations;
    for (const MotionSettings& motion : protocol.motions)
        if (std::ranges::find(durations.choices_s, motion.duration_s) == durations.choices_s.end())
            durations.choices_s.push_back(motion.duration_s);
    return durations;
}

std::string gaze_text(const GazeWait& wait) {
    const std::string where =
        wait.within_deg ? fmt::format("within {:g} deg", *wait.within_deg) : fmt::format("on {}", wait.area);
    std::string text = fmt::format("until gaze is {}{} for {:g} s", where,
                                   wait.slot.empty() ? "" : " in " + wait.slot, wait.for_s);
    if (wait.patience_s)
        text += fmt::format(", for {:g} s at most: then {}", *wait.patience_s,
                            wait.otherwise == GazeMissed::goes_on       ? "the trial goes on"
                            : wait.otherwise == GazeMissed::drift_check ? "a drift check, and the step again"
                                                                        : "the attempt is over");
    return text;
}

std::string shown_text(const Protocol& protocol, const StepSettings& step) {
    if (step.kind == StepKind::show && protocol.slots.size() > 1)
        return fmt::format("what the trial has in {}", fmt::join(step.slots, ", "));
    if (step.kind == StepKind::mask)
        return step.is_scrambled ? "what was shown, scrambled" : "noise where stimuli stand";
    return std::string(row_of(step.kind).shows);
}

} // namespace

std::string describe_steps(const Protocol& protocol, const Task& task) {
    if (task.steps.empty())
        return {};
    const double refresh_hz = protocol.display.refresh_hz;
    std::string text = fmt::format("steps of task {}:\n", task.id);
    double least_s = 0.0, most_s = 0.0;
    bool has_end = true;
    for (std::size_t i = 0; i < task.steps.size(); ++i) {
        const StepSettings& step = task.steps[i];
        std::vector<std::string> ends;
        const StepDuration motions = durations_of_motions(protocol);
        const bool is_motion = step.kind == StepKind::show && !step.duration && !step.ends_by_answer;
        double shortest_s = is_motion ? motions.shortest_s() : 0.0;
        double longest_s = is_motion ? motions.longest_s() : 0.0;
        if (step.duration) {
            ends.push_back(duration_text(*step.duration, refresh_hz));
            shortest_s = step.duration->shortest_s();
            longest_s = step.duration->longest_s();
        } else if (is_motion) {
            ends.push_back(duration_text({StepDuration::Law::fixed, motions.choices_s}, refresh_hz) +
                           (motions.choices_s.size() > 1 ? ", by the motion" : ""));
        }
        if (step.gaze) {
            ends.push_back(gaze_text(*step.gaze));
            shortest_s = std::min(step.gaze->for_s, shortest_s > 0.0 ? shortest_s : step.gaze->for_s);
            if (longest_s <= 0.0)
                longest_s = step.gaze->patience_s.value_or(0.0);
        }
        const bool waits_for_key = step.ends_by_key || (step.kind == StepKind::text && !step.duration);
        if (waits_for_key)
            ends.push_back("until a key is pressed");
        if (step.kind == StepKind::answer || step.ends_by_answer)
            ends.push_back("until the answer");
        if (waits_for_key || step.kind == StepKind::answer || step.ends_by_answer ||
            step.kind == StepKind::drift_check)
            shortest_s = 0.0;
        has_end = has_end && longest_s > 0.0;
        least_s += shortest_s;
        most_s += longest_s;
        std::string line = fmt::format("  {}. {}{}: {}", i + 1, row_of(step.kind).name,
                                       step.id.empty() ? "" : " " + step.id, shown_text(protocol, step));
        for (std::size_t k = 0; k < ends.size(); ++k)
            line += fmt::format("{}{}", k == 0 ? "; " : "; or ", ends[k]);
        text += line + "\n";
    }
    text += has_end ? fmt::format("  together {:g} to {:g} s\n", least_s, most_s)
                    : fmt::format("  together {:g} s at least\n", least_s);
    return text;
}

} // namespace overt
