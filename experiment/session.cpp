#include "experiment/session.h"

#include <cmath>

#include <fmt/format.h>

namespace overt {

namespace {

/// How often the keys are looked at while a screen stands still.
constexpr SessionDuration key_interval = std::chrono::milliseconds(4);

/// Readings of both clocks at each end of a presentation.
constexpr int clock_readings = 8;

/// The two clocks that tell of a sleep are read one after the other: less than this may be that.
constexpr double shortest_sleep_s = 0.005;

/// A wall clock that is kept right over a network is slewed by up to 0.5 ms a second: 40 ms in a minute and a
/// half is that, more is a step.
constexpr double smallest_wall_step_s = 0.1;

/// Nobody rests for longer without meaning to leave.
constexpr double longest_break_s = 3600.0;

/// Of practice, events alone are kept: rows of flips and samples are of trials that count.
class PracticeLog final : public SessionLog {
  public:
    explicit PracticeLog(SessionLog& record) : record_(record) {}
    void flip(const FlipRecord&) noexcept override {}
    void missed(const MissedRefresh&) noexcept override {}
    void sample(int, const GazeSample&) noexcept override {}
    void clock_pair(const ClockPair& pair) noexcept override { record_.clock_pair(pair); }
    void event(const SessionEvent& event) override {
        record_.event({event.at, -1, event.kind,
                       event.detail.empty() ? "in practice" : event.detail + ", in practice"});
    }
    void trial_started(const Trial&, SessionTime) override {}
    void trial_finished(const Trial&, const TrialOutcome&) override {}

  private:
    SessionLog& record_;
};

} // namespace

Session::Session(const Protocol& protocol, const Schedule& schedule, const ScreenPoint& screen_centre,
                 SessionPorts ports)
    : protocol_(&protocol), schedule_(&schedule), screen_centre_(screen_centre), ports_(std::move(ports)),
      cycle_(make_page_cycle(protocol.animation, protocol.display.refresh_hz)),
      ledger_(cycle_, protocol.animation.when_late), log_(&ports_.log), samples_(4096) {}

SessionResult Session::run(const TrialDone& trial_done) {
    SessionResult result;
    const ScreenSettings& screens = protocol_->screens;
    if (read_text(screens.welcome_text, 0.0)) {
        show({});
        result.validation = ports_.tracker.calibrate();
        ports_.log.event(
            {ports_.clock.now(), -1, "validation",
             fmt::format("mean error {:.3f} deg, largest {:.3f} deg", result.validation.mean_error.value,
                         result.validation.max_error.value)});
        TrialQueue queue(*protocol_, *schedule_);
        while (!aborted_) {
            const std::optional<SessionStep> step = queue.next();
            if (!step)
                break;
            run_step(queue, *step, result, trial_done);
        }
    }
    // Closing the farewell's window ends nothing that was not already done.
    result.aborted = aborted_;
    if (!aborted_)
        read_text(screens.farewell_text, 0.0);
    if (result.aborted) {
        result.reason = ports_.presenter.closed() ? ports_.presenter.why_closed()
                        : ports_.tracker.lost()   ? "the eye tracker was lost"
                                                  : "aborted by a key";
    }
    ports_.log.event(
        {ports_.clock.now(), -1, result.aborted ? "session aborted" : "session completed", result.reason});
    return result;
}

void Session::run_step(TrialQueue& queue, const SessionStep& step, SessionResult& result,
                       const TrialDone& trial_done) {
    switch (step.kind) {
    case SessionStep::Kind::instructions:
        read_text(protocol_->blocks[static_cast<std::size_t>(step.block)].instructions, 0.0);
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
    Attempt attempt = run_trial(step.trial, queue.expected());
    judge(queue, step.trial, attempt);
    ports_.log.trial_finished(step.trial, attempt.outcome);
    result.missed_refreshes += attempt.outcome.missed_refreshes;
    if (attempt.outcome.status == TrialOutcome::Status::completed)
        ++result.completed_trials;
    if (trial_done)
        trial_done(step.trial, attempt.outcome, result.completed_trials);
}

/// Whether an attempt counts. One that the whole session ended in does not, and nothing comes after it.
void Session::judge(TrialQueue& queue, const Trial& trial, Attempt& attempt) {
    if (aborted_)
        return;
    const AttemptVerdict verdict = queue.tell(attempt.result);
    attempt.outcome.status = verdict.counts ? TrialOutcome::Status::completed : TrialOutcome::Status::aborted;
    if (verdict.failure == TrialFailure::none)
        return;
    constexpr std::string_view afterwards[] = {"does not come again", "comes again now",
                                               "comes again at the end of the block"};
    ports_.log.event({ports_.clock.now(), trial.index, "trial failed",
                      fmt::format("{} ({} refreshes missed, {:.1f} % of samples without gaze): {}{}",
                                  name_of(verdict.failure), attempt.result.missed_refreshes,
                                  100.0 * attempt.result.gaze_lost_share,
                                  afterwards[static_cast<int>(verdict.comes_again)],
                                  verdict.counts ? ", and counts as it is" : "")});
}

void Session::run_practice(const SessionStep& step, const std::optional<Condition>& next) {
    const Trial& trial = step.trial;
    const PracticeSettings& practice = protocol_->practice[static_cast<std::size_t>(trial.index)];
    ports_.log.event({ports_.clock.now(), -1, "practice",
                      fmt::format("{}: {}, {}, {}", trial.index + 1, practice.task, practice.sculpture,
                                  practice.material)});
    PracticeLog log(ports_.log);
    log_ = &log;
    const Attempt attempt = run_trial(trial, next);
    log_ = &ports_.log;
    if (aborted_)
        return;
    ports_.log.event({ports_.clock.now(), -1, "practice answered", attempt.outcome.answer});
    read_text(practice.feedback, 0.0);
}

void Session::run_break() {
    const BreakSettings& breaks = protocol_->breaks;
    ports_.log.event({ports_.clock.now(), -1, "break begins", ""});
    const SessionTime onset = show({Screen::Kind::text, breaks.text});
    const bool is_timed = breaks.pace == BreakPace::timed;
    if (!is_timed)
        ports_.panel.await_key(onset);
    SessionTime pressed_at;
    wait_for_press(onset, is_timed ? breaks.duration_s : breaks.min_s,
                   is_timed ? breaks.duration_s : longest_break_s, pressed_at);
    ports_.log.event({ports_.clock.now(), -1, "break ends", ""});
}

Session::Attempt Session::run_trial(const Trial& trial, const std::optional<Condition>& next) {
    Attempt attempt;
    TrialOutcome& outcome = attempt.outcome;
    const ScreenSettings& screens = protocol_->screens;
    const Task& task = protocol_->tasks[static_cast<std::size_t>(trial.task)];
    ports_.presenter.load_frames(trial.condition);
    log_->trial_started(trial, ports_.clock.now());
    const Clock::Disturbance before = ports_.clock.disturbance();
    outcome.status = TrialOutcome::Status::aborted;

    outcome.task_screen_onset = show({Screen::Kind::text, task.question});
    ports_.panel.await_key(outcome.task_screen_onset);
    SessionTime read_at;
    const Answer read =
        wait_for_press(outcome.task_screen_onset, screens.task_min_s, screens.response_max_s, read_at);
    attempt.result.is_rejected = read == Answer::rejected;
    if (read == Answer::pressed || read == Answer::timed_out) {
        check_drift(trial, outcome);
        present(trial, attempt);
    }
    if (!aborted_ && !attempt.result.is_rejected) {
        outcome.response_screen_onset = show({Screen::Kind::text, screens.response_text});
        ports_.panel.await_response(trial, outcome.response_screen_onset);
        if (next)
            ports_.presenter.expect_frames(*next);
        const Answer answer = wait_for_press(outcome.response_screen_onset, screens.response_min_s,
                                             screens.response_max_s, outcome.responded_at);
        if (answer == Answer::timed_out)
            log_->event({outcome.responded_at, trial.index, "response timed out", ""});
        if (answer == Answer::pressed)
            outcome.answer = ports_.panel.answer();
        attempt.result.is_rejected = answer == Answer::rejected;
    }
    note_disturbance(trial, before);
    return attempt;
}

/// A machine that slept in a trial lit nothing meanwhile, whatever the ledger says; a wall clock that was set
/// does no harm to session time, but shifts what other programs wrote down.
void Session::note_disturbance(const Trial& trial, const Clock::Disturbance& before) {
    const Clock::Disturbance now = ports_.clock.disturbance();
    const double slept_s = to_seconds(now.slept - before.slept);
    const double moved_s = to_seconds(now.wall_moved - before.wall_moved);
    if (slept_s > shortest_sleep_s)
        log_->event({ports_.clock.now(), trial.index, "machine slept",
                     fmt::format("{:.3f} s, in which nothing was shown or recorded", slept_s)});
    if (std::abs(moved_s) > smallest_wall_step_s)
        log_->event({ports_.clock.now(), trial.index, "wall clock was set",
                     fmt::format("by {:+.3f} s; session time went on as before", moved_s)});
}

void Session::check_drift(const Trial& trial, TrialOutcome& outcome) {
    const SessionTime onset = show({Screen::Kind::drift_target, ""});
    ports_.clock.wait_until(onset + from_seconds(protocol_->screens.drift_target_s));
    outcome.drift = ports_.tracker.drift_check(screen_centre_);
    if (!outcome.drift) {
        log_->event({ports_.clock.now(), trial.index, "drift check failed", "no eye was found"});
    } else if (outcome.drift->value > protocol_->tracker.drift_limit_deg) {
        log_->event({ports_.clock.now(), trial.index, "drift check failed",
                     fmt::format("{:.3f} deg is more than the limit of {} deg", outcome.drift->value,
                                 protocol_->tracker.drift_limit_deg)});
    }
}

void Session::present(const Trial& trial, Attempt& attempt) {
    TrialOutcome& outcome = attempt.outcome;
    const SessionDuration lead = from_seconds(protocol_->screens.recording_lead_s);
    read_clocks();
    ports_.tracker.start_recording();
    show({});
    wait_and_take_samples(trial.index, ports_.clock.now() + lead);
    for (DisplayWitness* witness : ports_.witnesses)
        witness->presentation_begins(trial);

    sample_count_ = lost_count_ = 0;
    // From here to the last flip nothing allocates, opens, throws or formats.
    ledger_.begin(trial.index);
    while (!ledger_.is_complete() && !went_away()) {
        // Take what the tracker has seen so far.
        take_samples(trial.index);
        // Show the frame that the plan has next, and learn when it was lit.
        const FlipRecord& flip = ledger_.enter(ports_.presenter.flip(ledger_.next().frame));
        // Write down what became of each refresh, and let those see it who watch.
        for (int i = 0; i < ledger_.missed_count(); ++i)
            log_->missed(ledger_.missed(i));
        log_->flip(flip);
        for (DisplayWitness* witness : ports_.witnesses)
            witness->saw(flip);
    }
    outcome.presentation_onset = ledger_.onset();
    outcome.shown_refreshes = ledger_.shown_refreshes();
    outcome.missed_refreshes = ledger_.missed_refreshes();
    attempt.result.missed_refreshes = outcome.missed_refreshes;
    if (sample_count_ > 0)
        attempt.result.gaze_lost_share =
            static_cast<double>(lost_count_) / static_cast<double>(sample_count_);

    outcome.presentation_end = show({});
    aborted_ = went_away();
    wait_and_take_samples(trial.index, ports_.clock.now() + lead);
    ports_.tracker.stop_recording();
    take_samples(trial.index);
    read_clocks();
}

SessionTime Session::show(const Screen& screen) {
    const SessionTime onset = ports_.presenter.show(screen).vertical_blank;
    for (DisplayWitness* witness : ports_.witnesses)
        witness->saw_screen(screen, onset);
    return onset;
}

bool Session::read_text(const std::string& text, double min_s) {
    if (text.empty())
        return true;
    const SessionTime onset = show({Screen::Kind::text, text});
    ports_.panel.await_key(onset);
    SessionTime pressed_at;
    return wait_for_press(onset, min_s, protocol_->screens.response_max_s, pressed_at) != Answer::aborted;
}

Session::Answer Session::wait_for_press(SessionTime since, double min_s, double max_s,
                                        SessionTime& pressed_at) {
    const SessionTime earliest = since + from_seconds(min_s), latest = since + from_seconds(max_s);
    while (ports_.clock.now() < latest) {
        while (const std::optional<ResponsePress> press = ports_.panel.poll()) {
            aborted_ = press->key == ResponsePress::Key::abort;
            pressed_at = press->pressed_at;
            if (aborted_)
                return Answer::aborted;
            if (press->key == ResponsePress::Key::reject)
                return Answer::rejected;
            if (press->pressed_at >= earliest)
                return Answer::pressed;
        }
        if (went_away()) {
            aborted_ = true;
            return Answer::aborted;
        }
        ports_.presenter.use_spare_time();
        ports_.clock.wait_until(ports_.clock.now() + key_interval);
    }
    pressed_at = latest;
    return Answer::timed_out;
}

void Session::take_samples(int trial) noexcept {
    std::size_t taken = 0;
    do {
        taken = ports_.tracker.poll(samples_);
        for (std::size_t i = 0; i < taken; ++i) {
            ++sample_count_;
            lost_count_ += samples_[i].gaze ? 0 : 1;
            log_->sample(trial, samples_[i]);
        }
    } while (taken == samples_.size());
}

void Session::wait_and_take_samples(int trial, SessionTime until) noexcept {
    while (ports_.clock.now() < until) {
        take_samples(trial);
        ports_.clock.wait_until(std::min(until, ports_.clock.now() + key_interval));
    }
    take_samples(trial);
}

void Session::read_clocks() noexcept {
    for (int i = 0; i < clock_readings; ++i)
        log_->clock_pair(ports_.tracker.read_clocks());
}

} // namespace overt
