#include "experiment/session/trial_run.h"

#include <cmath>

#include <fmt/format.h>

#include "experiment/ports/event_kinds.h"
#include "experiment/session/answer_check.h"
#include "experiment/session/level_watch.h"

namespace overt {

namespace {

constexpr SessionDuration poll_interval = std::chrono::milliseconds(4);

/// Readings of both clocks at each end of a presentation.
constexpr int clock_readings = 8;

/// The two clocks that tell of a sleep are read one after the other: less than this may be that.
constexpr double shortest_sleep_s = 0.005;

/// A wall clock that is kept right over a network is slewed by up to 0.5 ms a second: 40 ms in a minute and a
/// half is that, more is a step.
constexpr double smallest_wall_step_s = 0.1;

/// An answer's file is complete some milliseconds after its last sample has come; a device that has stopped
/// must not stop the session.
constexpr SessionDuration longest_wait_for_answer = std::chrono::seconds(2);

using How = OperatorDesk::How;

} // namespace

TrialRun::TrialRun(SessionStage& stage, OperatorDesk& desk, const ScreenPoint& screen_centre)
    : stage_(stage), desk_(desk), screen_centre_(screen_centre),
      cycle_(make_page_cycle(stage.protocol.animation, stage.protocol.display.refresh_hz)),
      ledger_(cycle_, stage.protocol.animation.when_late), samples_(4096) {}

TrialRun::Attempt TrialRun::run(const Trial& trial, const std::optional<Condition>& next, bool is_practice) {
    Attempt attempt;
    attempt.outcome.status = TrialOutcome::Status::aborted;
    desk_.begin_trial();
    stage_.enter(SessionPhase::trial, is_practice ? -1 : trial.index);
    stage_.ports.presenter.load_frames(trial.condition);
    stage_.log().trial_started(trial, stage_.now());
    const Clock::Disturbance before = stage_.ports.clock.disturbance();
    ask(trial, attempt);
    if (goes_on(attempt))
        check_drift(attempt.outcome);
    if (goes_on(attempt)) {
        present(trial, attempt);
        act_on_pressed_keys(attempt);
    }
    if (goes_on(attempt))
        take_answer(trial, next, is_practice, attempt);
    note_disturbance(before);
    const TrialDecision::Word word = desk_.decision().word;
    attempt.result.is_rejected = attempt.result.is_rejected || word == TrialDecision::Word::rejected;
    attempt.result.is_repeated = word == TrialDecision::Word::repeated;
    attempt.result.is_skipped = word == TrialDecision::Word::skipped;
    return attempt;
}

bool TrialRun::goes_on(const Attempt& attempt) const {
    return !stage_.is_over() && !attempt.result.is_rejected &&
           desk_.decision().word == TrialDecision::Word::none;
}

void TrialRun::ask(const Trial& trial, Attempt& attempt) {
    const ScreenSettings& screens = stage_.protocol.screens;
    stage_.enter(SessionPhase::task_screen, stage_.trial());
    const Screen screen{Screen::Kind::text,
                        stage_.protocol.tasks[static_cast<std::size_t>(trial.task)].question};
    attempt.outcome.task_screen_onset = stage_.show(screen);
    desk_.wait({.screen = screen,
                .onset = attempt.outcome.task_screen_onset,
                .min_s = screens.task_min_s,
                .max_s = without_end_s});
}

void TrialRun::check_drift(TrialOutcome& outcome) {
    stage_.enter(SessionPhase::drift_check, stage_.trial());
    const Screen target{Screen::Kind::drift_target, ""};
    const How how = desk_
                        .wait({.screen = target,
                               .onset = stage_.show(target),
                               .max_s = stage_.protocol.screens.drift_target_s,
                               .await = [](SessionTime) {}, // of the observer nothing is
                               .takes_keys = false,
                               .starts_over = true})
                        .how;
    if (how != How::timed_out)
        return;
    outcome.drift = stage_.ports.tracker.drift_check(screen_centre_);
    const double limit_deg = stage_.protocol.tracker.drift_limit_deg;
    if (!outcome.drift)
        stage_.note(drift_check_failed_event, "no eye was found");
    else if (outcome.drift->value > limit_deg)
        stage_.note(drift_check_failed_event, fmt::format("{:.3f} deg is more than the limit of {} deg",
                                                          outcome.drift->value, limit_deg));
}

void TrialRun::present(const Trial& trial, Attempt& attempt) {
    TrialOutcome& outcome = attempt.outcome;
    SessionLog& log = stage_.log();
    const SessionPorts& ports = stage_.ports;
    const SessionDuration lead = from_seconds(stage_.protocol.screens.recording_lead_s);
    stage_.enter(SessionPhase::stimulus, stage_.trial());
    read_clocks();
    ports.tracker.start_recording();
    stage_.show({});
    wait_and_take_samples(trial.index, stage_.now() + lead);
    for (DisplayWitness* witness : ports.witnesses)
        witness->presentation_begins(trial);

    sample_count_ = lost_count_ = 0;
    pressed_.reset();
    const auto is_broken_off = [&] { return pressed_ && pressed_->key == ResponsePress::Key::abort; };
    // From here to the last flip nothing allocates, opens, throws or formats.
    ledger_.begin(trial.index);
    while (!ledger_.is_complete() && !stage_.went_away() && !is_broken_off()) {
        // Take what the tracker has seen so far.
        take_samples(trial.index);
        // Show the frame that the plan has next, and learn when it was lit.
        const FlipRecord& flip = ledger_.enter(ports.presenter.flip(ledger_.next().frame));
        // Write down what became of each refresh, and let those see it who watch.
        for (int i = 0; i < ledger_.missed_count(); ++i)
            log.missed(ledger_.missed(i));
        log.flip(flip);
        for (DisplayWitness* witness : ports.witnesses)
            witness->saw(flip);
        // Remember what the operator pressed.
        look_at_keys();
    }
    outcome.presentation_onset = ledger_.onset();
    outcome.shown_refreshes = ledger_.shown_refreshes();
    outcome.missed_refreshes = ledger_.missed_refreshes();
    attempt.result.missed_refreshes = outcome.missed_refreshes;
    if (sample_count_ > 0)
        attempt.result.gaze_lost_share =
            static_cast<double>(lost_count_) / static_cast<double>(sample_count_);

    outcome.presentation_end = stage_.show({});
    stage_.ends_by_itself();
    wait_and_take_samples(trial.index, stage_.now() + lead);
    ports.tracker.stop_recording();
    take_samples(trial.index);
    read_clocks();
}

void TrialRun::look_at_keys() noexcept {
    while (const std::optional<ResponsePress> press = stage_.ports.panel.poll()) {
        const bool ends_it = press->key == ResponsePress::Key::abort;
        // Whoever wants the animation to end means that more than what was pressed before.
        if (is_operators(press->key) && (!pressed_ || ends_it))
            pressed_ = press;
    }
}

void TrialRun::act_on_pressed_keys(Attempt& attempt) {
    if (!pressed_ || stage_.is_over())
        return;
    const bool was_broken_off = !ledger_.is_complete();
    if (was_broken_off)
        stage_.log().event({pressed_->pressed_at, stage_.trial(), presentation_broken_off_event,
                            fmt::format("by a key, after {} refreshes", attempt.outcome.shown_refreshes)});
    desk_.act_on(*pressed_);
    // Half an animation is no stimulus: taken back or not, this attempt does not count.
    attempt.result.is_rejected = was_broken_off;
}

void TrialRun::take_answer(const Trial& trial, const std::optional<Condition>& next, bool is_practice,
                           Attempt& attempt) {
    const ScreenSettings& screens = stage_.protocol.screens;
    TrialOutcome& outcome = attempt.outcome;
    SessionPorts& ports = stage_.ports;
    stage_.enter(SessionPhase::response_screen, stage_.trial());
    std::unique_ptr<AnswerRecording> recording;
    if (ports.recorder && !is_practice)
        recording = ports.recorder->begin(trial);
    const Screen screen{Screen::Kind::text, screens.response_text};
    outcome.response_screen_onset = stage_.show(screen);
    if (recording)
        recording->response_screen_lit(outcome.response_screen_onset);
    if (next)
        ports.presenter.expect_frames(*next);
    Waiting waiting{.screen = screen,
                    .onset = outcome.response_screen_onset,
                    .min_s = screens.response_min_s,
                    .max_s = screens.response_max_s};
    waiting.await = [&](SessionTime since) { ports.panel.await_response(trial, since); };
    LevelWatch watch(stage_.protocol.words, outcome.response_screen_onset);
    const bool shows_level = stage_.protocol.answers.meter_on_screen;
    if (recording && (ports.on_level || shows_level))
        waiting.meanwhile = [&] {
            const AudioLevel level = recording->level();
            if (ports.on_level)
                ports.on_level(level);
            if (!shows_level)
                return;
            if (const std::optional<LevelBar> bar = watch.take(level, stage_.now()))
                ports.presenter.show_level(*bar);
        };
    const OperatorDesk::Press press = desk_.wait(waiting);
    outcome.responded_at = press.at;
    if (recording)
        recording->end(press.at);
    if (press.how == How::timed_out)
        stage_.log().event({press.at, stage_.trial(), response_timed_out_event, ""});
    if (press.how == How::next)
        outcome.answer = ports.panel.answer();
    if (recording)
        keep_answer(*recording);
}

void TrialRun::keep_answer(AnswerRecording& recording) {
    const SessionTime latest = stage_.now() + longest_wait_for_answer;
    std::optional<RecordedAnswer> answer = recording.result();
    while (!answer && stage_.now() < latest) {
        stage_.ports.presenter.use_spare_time();
        stage_.ports.clock.wait_until(stage_.now() + poll_interval);
        answer = recording.result();
    }
    if (!answer) {
        stage_.note(answer_recording_event,
                    "was not complete two seconds after its end: the file may be short");
        return;
    }
    for (const std::string& warning : warnings_about(*answer))
        stage_.note(answer_recording_event, warning);
    stage_.log().answer_recorded(*answer);
}

/// A machine that slept in a trial lit nothing meanwhile, whatever the ledger says; a wall clock that was set
/// does no harm to session time, but shifts what other programs wrote down.
void TrialRun::note_disturbance(const Clock::Disturbance& before) {
    const Clock::Disturbance now = stage_.ports.clock.disturbance();
    const double slept_s = to_seconds(now.slept - before.slept);
    const double moved_s = to_seconds(now.wall_moved - before.wall_moved);
    if (slept_s > shortest_sleep_s)
        stage_.note(machine_slept_event,
                    fmt::format("{:.3f} s, in which nothing was shown or recorded", slept_s));
    if (std::abs(moved_s) > smallest_wall_step_s)
        stage_.note(wall_clock_set_event,
                    fmt::format("by {:+.3f} s; session time went on as before", moved_s));
}

void TrialRun::take_samples(int trial) noexcept {
    std::size_t taken = 0;
    do {
        taken = stage_.ports.tracker.poll(samples_);
        for (std::size_t i = 0; i < taken; ++i) {
            ++sample_count_;
            lost_count_ += samples_[i].gaze ? 0 : 1;
            stage_.log().sample(trial, samples_[i]);
        }
    } while (taken == samples_.size());
}

void TrialRun::wait_and_take_samples(int trial, SessionTime until) noexcept {
    while (stage_.now() < until) {
        take_samples(trial);
        stage_.ports.clock.wait_until(std::min(until, stage_.now() + poll_interval));
    }
    take_samples(trial);
}

void TrialRun::read_clocks() noexcept {
    for (int i = 0; i < clock_readings; ++i)
        stage_.log().clock_pair(stage_.ports.tracker.read_clocks());
}

} // namespace overt
