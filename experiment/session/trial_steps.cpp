#include "experiment/session/trial_run.h"

#include <algorithm>

#include <fmt/format.h>

#include "experiment/ports/event_kinds.h"
#include "experiment/ports/trial_mark.h"
#include "experiment/session/session_screens.h"
#include "experiment/session/step_screens.h"

namespace overt {

namespace {

/// How often a step that waits for gaze looks at what has come.
constexpr SessionDuration look_interval = std::chrono::milliseconds(2);

StepEnd end_of(OperatorControl::How how, StepEnd by_key, StepEnd by_time) {
    switch (how) {
    case OperatorControl::How::timed_out:
        return by_time;
    case OperatorControl::How::trial_over:
    case OperatorControl::How::session_over:
        return StepEnd::stopped;
    default:
        return by_key;
    }
}

} // namespace

void TrialRun::run_steps(Running& running) {
    shows_ = 0;
    first_flip_.reset();
    for (Feed& feed : feeds_)
        feed.earlier = {};
    gaze_checks_ = 0;
    const std::vector<PlannedStep>& steps = running.plan.steps;
    for (std::size_t number = 0; number < steps.size() && goes_on(running.attempt);) {
        if (!steps[number].is_watched) {
            run_step(running, number++);
            continue;
        }
        std::size_t end = number;
        while (end < steps.size() && steps[end].is_watched)
            ++end;
        run_watched(running, number, end);
        number = end;
    }
    end_row(running, state_.now());
}

/// Steps during which gaze is recorded: nothing else happens between them.
void TrialRun::run_watched(Running& running, std::size_t begin, std::size_t end) {
    // Made before anything is shown: what follows a show must not allocate.
    held_.resize(running.plan.steps.size());
    for (std::size_t number = begin; number < end; ++number)
        held_[number] = screen_of(running.plan.steps[number], circumstances(running, number));
    for (std::size_t number = begin; number < end && goes_on(running.attempt);) {
        if (!begin_watching(running)) {
            act_on_tracker(running.attempt);
            act_on_pressed_keys(running.attempt);
            return;
        }
        bool starts_over = false;
        for (; number < end && !is_cut_short() && !starts_over && goes_on(running.attempt); ++number) {
            if (const PlannedStep& step = running.plan.steps[number];
                step.kind == StepKind::show && !step.places.empty())
                present(running, number);
            else
                hold(running, number);
            if (is_gaze_missed(running, number)) {
                starts_over = true;
                --number;
            }
        }
        has_ended_in_order_ =
            number == end && running.attempt.outcome.steps.back().ended_by != StepEnd::stopped;
        end_watching(running);
        act_on_tracker(running.attempt);
        act_on_pressed_keys(running.attempt);
        if (!starts_over)
            return;
        if (goes_on(running.attempt))
            check_drift(running, {.kind = StepKind::drift_check});
    }
}

/// Gaze did not come, and the step says what then: whether it begins anew after a drift check. An attempt
/// that is not to go on is rejected here.
bool TrialRun::is_gaze_missed(Running& running, std::size_t number) {
    const PlannedStep& step = running.plan.steps[number];
    const AttemptStep& row = running.attempt.outcome.steps.back();
    if (!step.gaze() || row.ended_by != StepEnd::patience || step.gaze()->otherwise == GazeMissed::goes_on)
        return false;
    if (step.gaze()->otherwise == GazeMissed::drift_check &&
        gaze_checks_ < state_.protocol.tracker.drift_checks) {
        ++gaze_checks_;
        return true;
    }
    control_.reject_trial("gaze did not come to where it was waited for");
    return false;
}

void TrialRun::run_step(Running& running, std::size_t number) {
    const PlannedStep& step = running.plan.steps[number];
    switch (step.kind) {
    case StepKind::text:
        if (!step.settings || !step.refreshes)
            ask(running, number);
        else
            stand(running, number);
        break;
    case StepKind::drift_check:
        check_drift(running, step);
        break;
    case StepKind::answer:
        take_answer(running, number);
        break;
    case StepKind::fixation:
    case StepKind::blank:
    case StepKind::mask:
    case StepKind::feedback:
        stand(running, number);
        break;
    case StepKind::show:
        break; // is watched
    }
}

/// Something else than what the step before shows is on the screen.
void TrialRun::end_row(Running& running, SessionTime lit) {
    TrialOutcome& outcome = running.attempt.outcome;
    if (outcome.steps.empty() || outcome.steps.back().end)
        return;
    outcome.steps.back().end = lit;
    if (outcome.steps.back().kind == name_of(StepKind::show))
        asking_.stimulus_gone(lit);
}

/// A row for a step that is come to; its times come later, so that nothing is allocated between flips.
void TrialRun::add_row(Running& running, const PlannedStep& step) {
    AttemptStep& row = running.attempt.outcome.steps.emplace_back();
    row.kind = name_of(step.kind);
    row.id = step.id;
    row.planned_refreshes = step.refreshes;
    row.drawn_s = step.drawn_s;
    if (step.still())
        row.still_frame = step.still()->value;
    if (step.kind == StepKind::show)
        row.places = step.places;
}

/// What the step added last shows is on the screen, and what the one before showed is not.
void TrialRun::begin_row(Running& running, SessionTime lit) noexcept {
    std::vector<AttemptStep>& rows = running.attempt.outcome.steps;
    if (rows.size() > 1 && !rows[rows.size() - 2].end) {
        rows[rows.size() - 2].end = lit;
        if (rows[rows.size() - 2].kind == name_of(StepKind::show))
            asking_.stimulus_gone(lit);
    }
    rows.back().begin = lit;
}

std::string TrialRun::step_text(const PlannedStep& step) {
    return fmt::format("STEP {}{}{}", name_of(step.kind), step.id.empty() ? "" : " ", step.id);
}

/// The question of a task without steps is told by the phase alone, as ever.
void TrialRun::mark_step(const PlannedStep& step, SessionTime lit) {
    if (!step.settings)
        return;
    const std::string text = step_text(step);
    mark_trackers(lit, text);
    state_.markers.tell(lit, text);
}

/// A text that a key ends: the question, or the step's.
void TrialRun::ask(Running& running, std::size_t number) {
    asking_.interrupted();
    const ScreenSettings& screens = state_.protocol.screens;
    const PlannedStep& step = running.plan.steps[number];
    TrialOutcome& outcome = running.attempt.outcome;
    if (state_.phase() != SessionPhase::task_screen)
        state_.enter(SessionPhase::task_screen, state_.trial());
    const Screen screen = step.settings
                              ? screen_of(step, {state_.protocol, running.trial, seed_, number, false})
                              : overt::screens::question(state_.protocol, running.trial.task);
    const SessionTime onset = state_.show(screen);
    if (outcome.task_screen_onset == SessionTime())
        outcome.task_screen_onset = onset;
    mark_step(step, onset);
    add_row(running, step);
    begin_row(running, onset);
    const OperatorControl::Press press = control_.wait(
        {.screen = screen, .onset = onset, .min_s = screens.task_min_s, .max_s = without_end_s});
    outcome.steps.back().ended_by = end_of(press.how, StepEnd::key, StepEnd::time);
}

void TrialRun::check_drift(Running& running, const PlannedStep& step) {
    asking_.interrupted();
    TrialOutcome& outcome = running.attempt.outcome;
    add_row(running, step);
    drift_checks_.check(outcome);
    begin_row(running, drift_checks_.began());
    outcome.steps.back().ended_by = goes_on(running.attempt) ? StepEnd::done : StepEnd::stopped;
}

void TrialRun::take_answer(Running& running, std::size_t number) {
    const PlannedStep& step = running.plan.steps[number];
    if (step.sheet >= 0) {
        ask_answers(running, number);
        return;
    }
    asking_.interrupted();
    TrialOutcome& outcome = running.attempt.outcome;
    add_row(running, step);
    const OperatorControl::How how =
        answers_.take(running.trial, running.next, running.is_practice, step.drawn_s, outcome);
    running.is_answered = how == OperatorControl::How::next;
    begin_row(running, outcome.response_screen_onset);
    AttemptStep& row = outcome.steps.back();
    row.ended_by = end_of(how, StepEnd::answer, StepEnd::time);
    row.end = outcome.responded_at;
}

/// The screen of answers by keys, the mouse or boxes; none where all was answered before it.
void TrialRun::ask_answers(Running& running, std::size_t number) {
    if (asking_.is_needless(number))
        return;
    const PlannedStep& step = running.plan.steps[number];
    TrialOutcome& outcome = running.attempt.outcome;
    add_row(running, step);
    SessionTime onset;
    const OperatorControl::Press press = asking_.ask(number, running.next, onset);
    if (outcome.response_screen_onset == SessionTime())
        outcome.response_screen_onset = onset;
    begin_row(running, onset);
    mark_step(step, onset);
    AttemptStep& row = outcome.steps.back();
    row.ended_by = end_of(press.how, StepEnd::answer, StepEnd::time);
    row.end = press.at;
}

/// What a step's words depend on.
StepCircumstances TrialRun::circumstances(const Running& running, std::size_t number) const {
    StepCircumstances of{state_.protocol, running.trial, seed_, number, running.is_answered};
    if (asking_.asks()) {
        of.is_answered = asking_.is_answered();
        of.is_correct = asking_.is_correct();
    }
    return of;
}

/// A screen that stands for a time, outside of what is watched.
void TrialRun::stand(Running& running, std::size_t number) {
    const PlannedStep& step = running.plan.steps[number];
    // What comes after the answer belongs to its screen.
    if (state_.phase() != SessionPhase::response_screen && state_.phase() != SessionPhase::task_screen)
        state_.enter(SessionPhase::task_screen, state_.trial());
    const StepCircumstances now = circumstances(running, number);
    const Screen screen = screen_of(step, now);
    const SessionTime onset = state_.show(screen);
    if (const std::optional<Beep> tone = tone_of(*step.settings, now); tone && state_.ports.on_beep)
        state_.ports.on_beep(*tone);
    mark_step(step, onset);
    add_row(running, step);
    begin_row(running, onset);
    // The next screen is asked for in the middle of the last refresh.
    const double max_s = (*step.refreshes - 0.5) / state_.protocol.display.refresh_hz;
    asking_.begin_standing_step(number, onset);
    const OperatorControl::Press press = control_.wait({.screen = screen,
                                                        .onset = onset,
                                                        .max_s = max_s,
                                                        .await = [](SessionTime) {},
                                                        .meanwhile = [&] { asking_.look(); },
                                                        .takes_keys = false});
    running.attempt.outcome.steps.back().ended_by = end_of(press.how, StepEnd::key, StepEnd::time);
}

/// A screen that stands while gaze is recorded, until time, a key or gaze ends it.
void TrialRun::hold(Running& running, std::size_t number) {
    const PlannedStep& step = running.plan.steps[number];
    // What only waits for an answer that came already is passed over.
    if (step.ends_by_answer() && asking_.is_needless(number))
        return;
    const double refresh_hz = state_.protocol.display.refresh_hz;
    const SessionTime onset = state_.show(held_[number]);
    mark_step(step, onset);
    add_row(running, step);
    begin_row(running, onset);
    await_end(running, number, onset);
    // The next screen is asked for in the middle of the last refresh.
    const auto after = [&](const std::optional<int>& refreshes) {
        return onset + from_seconds(refreshes ? (*refreshes - 0.5) / refresh_hz : without_end_s);
    };
    const SessionTime time_up = after(step.refreshes), patience_up = after(step.patience_refreshes);
    const SessionTime latest = std::min(time_up, patience_up);
    while (state_.now() < latest && !is_cut_short() && !watch_.has_come() && !was_next_pressed_ &&
           !asking_.has_ended(number)) {
        take_items(running.trial.index);
        look_at_keys();
        feeds_.front().items.look_at_state();
        if (!watch_.has_come())
            state_.ports.clock.wait_until(std::min(latest, state_.now() + look_interval));
    }
    AttemptStep& row = running.attempt.outcome.steps.back();
    row.ended_by = is_cut_short()              ? StepEnd::stopped
                   : watch_.has_come()         ? StepEnd::gaze
                   : was_next_pressed_         ? StepEnd::key
                   : asking_.has_ended(number) ? StepEnd::answer
                   : time_up <= patience_up    ? StepEnd::time
                                               : StepEnd::patience;
    take_gaze(row, step);
}

/// What ends the step besides time.
void TrialRun::await_end(Running& running, std::size_t number, SessionTime since) {
    const PlannedStep& step = running.plan.steps[number];
    was_next_pressed_ = false;
    awaits_key_ = step.ends_by_key();
    if (awaits_key_)
        state_.ports.panel.await_key(since);
    asking_.begin_watched_step(number, since, awaits_key_);
    watch_.end();
    const GazeWait* const wait = step.gaze();
    if (!wait)
        return;
    const std::vector<int> slots = slots_named(state_.protocol, {wait->slot});
    GazeAim aim{target_of(*step.settings, screen_geometry_of(state_.protocol)), {}};
    if (!slots.empty())
        aim.point = middle_of_slot(state_.protocol, slots.front());
    for (const int place : step.places) {
        const PlacedStimulus placed = running.trial.shown(static_cast<std::size_t>(place));
        const bool is_meant = slots.empty() || std::ranges::find(slots, placed.slot) != slots.end();
        if (wait->area.empty() || !is_meant || !state_.ports.area_of)
            continue;
        if (std::shared_ptr<const AreaView> area = state_.ports.area_of(placed, wait->area))
            aim.areas.push_back({place, std::move(area)});
    }
    if (wait->area.empty() || !aim.areas.empty())
        watch_.begin(*wait, std::move(aim), step.places.empty() ? 0 : step.places.front(), since,
                     feeds_.front().items.readings(), state_.ports.tracker.description());
}

void TrialRun::take_gaze(AttemptStep& row, const PlannedStep& step) const {
    if (!step.gaze() || row.ended_by != StepEnd::gaze)
        return;
    row.gaze_onset = watch_.condition().onset();
    row.gaze_detected = watch_.condition().detected();
}

bool TrialRun::is_cut_short() const noexcept {
    return state_.went_away() || (pressed_ && pressed_->key == ResponsePress::Key::abort) ||
           feeds_.front().items.state() != RecordingState::running;
}

/// Begins to record gaze; false if the session's own tracker does not.
bool TrialRun::begin_watching(Running& running) {
    has_ended_in_order_ = has_shown_ = false;
    if (state_.phase() != SessionPhase::stimulus)
        state_.enter(SessionPhase::stimulus, state_.trial());
    read_clocks();
    for (Feed& feed : feeds_)
        if (const std::optional<SessionDuration> jump = feed.items.take_jump())
            state_.note_of(feed.used, tracker_clock_jumped_event,
                           fmt::format("by {:+.3f} ms before the trial", 1e3 * to_seconds(*jump)));
    start_recording();
    if (!feeds_.front().items.has_recorded())
        return false;
    end_row(running, state_.show({}));
    wait_and_take_items(running.trial.index,
                        state_.now() + from_seconds(state_.protocol.screens.recording_lead_s));
    return true;
}

void TrialRun::end_watching(Running& running) {
    TrialOutcome& outcome = running.attempt.outcome;
    watch_.end();
    awaits_key_ = false;
    const SessionTime dark = state_.show({});
    end_row(running, dark);
    if (has_shown_) {
        const auto last = std::ranges::find(outcome.steps.rbegin(), outcome.steps.rend(),
                                            name_of(StepKind::show), &AttemptStep::kind);
        outcome.presentation_end = last == outcome.steps.rend() ? dark : last->end.value_or(dark);
        if (const std::optional<SwapModes> swaps = state_.ports.presenter.take_swap_modes())
            outcome.swaps = outcome.swaps.value_or(SwapModes()) + *swaps;
        mark(MarkedEvent::end, outcome.presentation_end, presentation_end_mark);
    }
    state_.ends_by_itself();
    wait_and_take_items(running.trial.index,
                        state_.now() + from_seconds(state_.protocol.screens.recording_lead_s));
    for (Feed& feed : feeds_)
        feed.items.stop_recording(state_.now());
    take_items(running.trial.index);
    read_clocks();
    for (Feed& feed : feeds_)
        feed.items.look_at_state();
    note_what_came(running.attempt);
    note_lost_trackers();
}

} // namespace overt
