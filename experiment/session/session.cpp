#include "experiment/session/session.h"
#include "experiment/session/missed_in_words.h"

#include <algorithm>

#include <fmt/format.h>

#include "experiment/base/counted.h"
#include "experiment/ports/event_kinds.h"
#include "experiment/protocol/all_stimuli.h"
#include "experiment/session/form_filling.h"
#include "experiment/session/session_opening.h"
#include "experiment/session/session_screens.h"

namespace overt {

namespace {

/// An observer who rests for longer has left.
constexpr double longest_break_s = 3600.0;

TrialOutcome::Afterwards afterwards_of(const AttemptVerdict& verdict) {
    using enum TrialOutcome::Afterwards;
    if (verdict.failure == TrialFailure::none)
        return never;
    constexpr TrialOutcome::Afterwards of[] = {never, now, end_of_block};
    return of[static_cast<int>(verdict.comes_again)];
}

/// Practice is repeated at once: there is no end of a block to move it to.
bool comes_again(const AttemptResult& practice, const RepeatSettings& repeats) {
    return practice.is_repeated || (practice.is_over() && repeats.rejected != RepeatWhen::never);
}

} // namespace

Session::Session(const Protocol& protocol, const Schedule& schedule, const ScreenPoint& screen_centre,
                 SessionPorts ports, FieldValues fields)
    : schedule_(schedule), ports_(std::move(ports)), state_(protocol, ports_), control_(state_),
      trials_(state_, control_, screen_centre, schedule_), fields_(std::move(fields)) {
    fields_.resize(protocol.observer_fields.size());
}

SessionResult Session::run(const TrialDone& trial_done, const SessionHistory& history) {
    SessionResult result;
    result.completed_trials = history.counted_trials;
    forms_done_ = history.forms;
    for (const RecordedStep& step : history.steps)
        if (step.kind == RecordedStep::Kind::trial)
            block_ = schedule_.trials[static_cast<std::size_t>(step.trial)].block;
    state_.note(phase_event, std::string(name_of(SessionPhase::set_up)));
    ports_.panel.entered(SessionPhase::set_up, -1);
    SessionOpening(state_, control_, fields_).run(history.is_opened);
    if (!state_.is_over()) {
        result.is_opened = true;
        control_.calibrate();
        TrialQueue queue(state_.protocol, schedule_);
        queue.go_through(history.steps);
        queue.take_left_out(); // which the record knows of
        take_answers(history);
        while (!state_.is_over()) {
            const std::optional<SessionStep> step = queue.next();
            if (!step)
                break;
            // What comes before the next trial is of its block, but for the feedback on the one before.
            const std::optional<Trial> next =
                step->kind == SessionStep::Kind::trial ? step->trial : queue.expected();
            if (block_ >= 0 && next && next->block != block_ && step->kind != SessionStep::Kind::feedback)
                ask_after_block(block_);
            if (!state_.is_over())
                run_step(queue, *step, result, trial_done);
        }
        control_.note_screen_changes(); // in the last trial
        if (!state_.is_over() && block_ >= 0)
            ask_after_block(block_);
        if (!state_.is_over())
            ask_at(std::string(form_at_end));
    }
    result.aborted = state_.is_over();
    result.reason = state_.why_over();
    state_.enter(SessionPhase::end);
    // All is done: a window that is closed during the farewell aborts nothing.
    if (!result.aborted)
        farewell();
    result.marker_warnings = state_.markers.finish(state_.log());
    for (const std::string& sentence : result.marker_warnings)
        state_.note(marker_output_event, sentence);
    state_.write_down();
    state_.note(result.aborted ? session_aborted_event : session_completed_event, result.reason);
    return result;
}

void Session::ask_after_block(int block) {
    if (static_cast<std::size_t>(block) < state_.protocol.blocks.size())
        ask_at(std::string(form_after_block) + state_.protocol.blocks[static_cast<std::size_t>(block)].id);
}

/// Once: a block whose trials were moved to its end, or that begins again, asks no second time.
void Session::ask_at(const std::string& when) {
    if (fields_asked(state_.protocol.observer_fields, when).empty() ||
        std::ranges::find(forms_done_, when) != forms_done_.end())
        return;
    state_.enter(SessionPhase::rest);
    if (fill_in_form(state_, control_, fields_, when))
        forms_done_.push_back(when);
}

void Session::farewell() {
    const Screen screen = screens::farewell(state_.protocol);
    if (screen.text.empty())
        return;
    const SessionTime onset = state_.show(screen);
    state_.note(text_shown_event, "farewell");
    ports_.panel.await_key(onset);
    const SessionTime latest = onset + from_seconds(state_.protocol.screens.response_max_s);
    // Any key ends it, the operator's as well.
    while (state_.now() < latest && !ports_.panel.poll() && !state_.went_away())
        ports_.clock.wait_until(state_.now() + std::chrono::milliseconds(4));
}

void Session::run_step(TrialQueue& queue, const SessionStep& step, SessionResult& result,
                       const TrialDone& trial_done) {
    control_.await_keyboard();
    control_.look_at_screen();
    if (state_.is_over())
        return;
    control_.regain_further_trackers();
    if (state_.is_over())
        return;
    switch (step.kind) {
    case SessionStep::Kind::feedback:
        give_feedback(step.block);
        return;
    case SessionStep::Kind::instructions:
        run_instructions(step);
        return;
    case SessionStep::Kind::practice:
        run_practice(step, queue.expected());
        return;
    case SessionStep::Kind::pause:
        run_break();
        return;
    case SessionStep::Kind::trial:
        break;
    }
    block_ = step.trial.block;
    if (step.choice)
        state_.record().event({state_.now(), step.trial.index, level_chosen_event, step.choice->in_words()});
    TrialRun::Attempt attempt = trials_.run(step.trial, queue.expected(), false);
    judge(queue, step.trial, attempt);
    state_.record().trial_finished(step.trial, attempt.outcome);
    result.missed_refreshes += attempt.outcome.missed_refreshes;
    if (attempt.outcome.status == TrialOutcome::Status::completed)
        ++result.completed_trials;
    if (trial_done)
        trial_done(step.trial, attempt.outcome, result.completed_trials);
}

/// Decides whether an attempt counts. One during which the session ended does not.
void Session::judge(TrialQueue& queue, const Trial& trial, TrialRun::Attempt& attempt) {
    if (state_.is_over()) {
        if (attempt.result.is_tracker_lost)
            attempt.outcome.failure = name_of(TrialFailure::tracker_lost);
        return;
    }
    attempt.result.given = attempt.outcome.given;
    const AttemptVerdict verdict = queue.tell(attempt.result);
    attempt.outcome.left_out = queue.take_left_out();
    if (verdict.counts)
        answered_[trial.block].push_back(attempt.outcome.given);
    attempt.outcome.status = verdict.counts ? TrialOutcome::Status::completed : TrialOutcome::Status::aborted;
    attempt.outcome.afterwards = afterwards_of(verdict);
    if (verdict.failure == TrialFailure::none)
        return;
    attempt.outcome.failure = name_of(verdict.failure);
    constexpr std::string_view afterwards[] = {"does not come again", "comes again now",
                                               "comes again at the end of the block"};
    const std::string why = control_.decision().why;
    state_.record().event(
        {state_.now(), trial.index, trial_failed_event,
         fmt::format("{}{}{} ({}, {:.1f} % of samples without gaze): {}{}", name_of(verdict.failure),
                     why.empty() ? "" : ": ", why,
                     missed_in_words(attempt.result.missed_refreshes, ports_.has_proven_times),
                     100.0 * attempt.result.gaze_lost_share,
                     afterwards[static_cast<int>(verdict.comes_again)],
                     verdict.counts ? ", and counts as it is" : "")});
}

/// What was answered in a block, to whom it was.
void Session::give_feedback(int block) {
    state_.enter(SessionPhase::block);
    const BlockSettings& settings = state_.protocol.blocks[static_cast<std::size_t>(block)];
    read_text(state_, control_, in_numbers(settings.feedback, answered_[block]),
              "feedback on block " + settings.id);
}

/// Of the trials that count; of an interrupted session those before.
void Session::take_answers(const SessionHistory& history) {
    int block = 0;
    for (const RecordedStep& step : history.steps) {
        if (step.kind == RecordedStep::Kind::resumed && step.policy == ResumePolicy::restart_block)
            answered_[block].clear();
        if (step.kind != RecordedStep::Kind::trial)
            continue;
        block = schedule_.trials.at(static_cast<std::size_t>(step.trial)).block;
        if (step.fate == AttemptFate::counted)
            answered_[block].push_back(step.given);
    }
}

void Session::run_instructions(const SessionStep& step) {
    state_.enter(SessionPhase::block);
    const BlockSettings& block = state_.protocol.blocks[static_cast<std::size_t>(step.block)];
    read_text(state_, control_, block.instructions, "instructions of block " + block.id);
}

void Session::run_practice(const SessionStep& step, const std::optional<Trial>& next) {
    const Trial& trial = step.trial;
    const PracticeSettings& practice = state_.protocol.practice[static_cast<std::size_t>(trial.index)];
    TrialRun::Attempt attempt;
    do {
        state_.record().event({state_.now(), -1, practice_event,
                               fmt::format("{}: {}, {}", trial.index + 1, practice.task,
                                           stimulus_in_words(state_.protocol, trial.stimulus))});
        state_.set_practice(true);
        attempt = trials_.run(trial, next, true);
        state_.set_practice(false);
        if (state_.is_over())
            return;
    } while (comes_again(attempt.result, state_.protocol.repeat));
    if (attempt.result.is_skipped || attempt.result.is_over()) {
        state_.record().event({state_.now(), -1, practice_skipped_event, control_.decision().why});
        return;
    }
    state_.record().event({state_.now(), -1, practice_answered_event, attempt.outcome.answer});
    if (practice.feedback.empty() || state_.phase() != SessionPhase::response_screen)
        return;
    state_.enter(SessionPhase::feedback);
    read_text(state_, control_, practice.feedback, "feedback");
}

void Session::run_break() {
    const BreakSettings& breaks = state_.protocol.breaks;
    state_.enter(SessionPhase::rest);
    state_.note(break_begins_event);
    // First the time in which keys do nothing, which is said; then, if a key ends it, which.
    const double asleep_s = screens::break_asleep_s(breaks);
    OperatorControl::How how = OperatorControl::How::timed_out;
    if (asleep_s > 0.0) {
        const Screen asleep = screens::break_asleep(state_.protocol);
        how = control_
                  .wait({.screen = asleep,
                         .onset = state_.show(asleep),
                         .max_s = asleep_s,
                         .await = [](SessionTime) {}, // no key is expected yet
                         .takes_keys = false})
                  .how;
    }
    if (breaks.pace == BreakPace::self && how == OperatorControl::How::timed_out) {
        const Screen awake = screens::break_awake(state_.protocol);
        control_.wait({.screen = awake, .onset = state_.show(awake), .max_s = longest_break_s});
    }
    state_.note(break_ends_event);
}

} // namespace overt
