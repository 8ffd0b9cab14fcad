/// What a trial is going to do, made before it runs.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "experiment/protocol/protocol.h"
#include "experiment/trial.h"

namespace overt {

/// A step with what was drawn for it. What it shows and waits for is in its settings.
struct PlannedStep {
    const StepSettings* settings = nullptr; ///< of the protocol; null in a task without steps
    StepKind kind = StepKind::blank;
    std::string id = {};
    std::optional<double> drawn_s = {};         ///< as drawn, or as the protocol has it
    std::optional<int> refreshes = {};          ///< the same rounded; nothing: it has no end in time
    std::optional<int> patience_refreshes = {}; ///< that gaze is waited for
    bool is_watched = false;                    ///< gaze is recorded meanwhile
    /// Of what the trial shows, rising: what `show` lights, and what `mask` covers: what the show before it
    /// lit, or, before the first, the next.
    std::vector<int> places = {};

    const GazeWait* gaze() const { return settings && settings->gaze ? &*settings->gaze : nullptr; }
    /// The only frame that `show` shows; nothing: the motion.
    std::optional<AnimationFrameIndex> still() const {
        return settings && settings->frame ? std::optional(AnimationFrameIndex{*settings->frame})
                                           : std::nullopt;
    }
    bool ends_by_key() const { return settings && settings->ends_by_key; }
    bool ends_by_answer() const { return settings && settings->ends_by_answer; }
    int sheet = -1; ///< of an answer, and of a step that one ends: index into TrialPlan::sheets; -1: none
};

/// Answers that are asked together: on the screen of one step, and in the steps before that wait for them.
struct PlannedSheet {
    std::vector<int> answers;  ///< indices into the task's
    bool waits_unseen = false; ///< a step that shows the stimulus, or waits, ends by them
    int stimulus_step = -1;    ///< the one whose stimulus their times count from; -1: none is shown before
};

struct TrialPlan {
    std::vector<PlannedStep> steps;
    std::vector<PlannedSheet> sheets; ///< in the order in which they are asked
};

/// Refreshes in so many seconds, at least one.
int refreshes_in(double seconds, double refresh_hz);

/// The steps of a trial's task. Durations are drawn from streams of their own by the session's seed, the
/// trial and the step, or are the trial's own (seconds_column): every attempt at a trial has the same. A task
/// without steps is a question, a drift check, the stimulus and its answers. Of a practice trial numbers are
/// drawn apart. The protocol must outlive the plan.
TrialPlan plan_trial(const Protocol& protocol, std::uint64_t seed, const Trial& trial, bool is_practice);

/// Whether gaze is recorded during each of a task's steps: while stimuli are shown, and in all steps without
/// answers and words directly before and after. Without a break where one such step follows another.
std::vector<bool> watched_steps(const std::vector<StepSettings>& steps);

/// What of a trial a step `show` lights: indices for Trial::shown, rising. None, where its slots are empty in
/// this trial.
std::vector<int> places_shown(const Protocol& protocol, const StepSettings& step, const Trial& trial);

/// A draw of a duration, in seconds, from a number in [0, 1). Exponential, cut off: from - tau log(1 - u (1 -
/// exp(-(to - from) / tau))).
double drawn_s(const StepDuration& duration, double u);

/// Lines on a task's steps for a person: what each shows, how long, in seconds and in refreshes, and what
/// else ends it; at last how long all of them last at least and at most. Empty for a task without steps.
std::string describe_steps(const Protocol& protocol, const Task& task);

} // namespace overt
