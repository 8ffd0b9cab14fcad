#include "experiment/session/operator_control.h"
#include "experiment/base/error.h"
#include "experiment/ports/event_kinds.h"
#include "experiment/ports/eye_tracker.h"
#include "experiment/ports/presenter.h"
#include "experiment/ports/response_panel.h"
#include "experiment/ports/session_phase.h"
#include "experiment/session/session_screens.h"
#include "experiment/session/session_setup_screen.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace overt {

namespace {

using ResponseKey = ResponsePress::Key;

} // namespace

void OperatorControl::rest_a_little(SessionTime latest) {
    state_.ports.presenter.use_spare_time();
    state_.write_down();
    state_.ports.clock.wait_until(std::min(latest, state_.now() + key_interval));
}

OperatorControl::Press OperatorControl::wait(const Waiting& waiting) {
    SessionTime earliest = waiting.onset + from_seconds(waiting.min_s);
    SessionTime latest = waiting.onset + from_seconds(waiting.max_s);
    const auto await = [&](SessionTime since) {
        if (waiting.await)
            waiting.await(since);
        else
            state_.ports.panel.await_key(since);
    };
    await(waiting.onset);
    while (state_.now() < latest) {
        while (const std::optional<ResponsePress> press = state_.ports.panel.poll()) {
            if (is_operators(press->key)) {
                const SessionTime began = state_.now();
                if (!act_on(*press))
                    return {state_.is_over() ? How::session_over : How::trial_over, press->pressed_at};
                const SessionTime shown_again = state_.show(waiting.screen);
                earliest += shown_again - began;
                latest = waiting.starts_over ? shown_again + from_seconds(waiting.max_s)
                                             : latest + (shown_again - began);
                await(shown_again);
                continue;
            }
            if (!waiting.takes_keys || press->pressed_at < earliest)
                continue;
            switch (press->key) {
            case ResponseKey::next:
                return {How::next, press->pressed_at, press->uncertainty};
            case ResponseKey::back:
            case ResponseKey::left:
                if (waiting.turns_pages)
                    return {How::back, press->pressed_at, press->uncertainty};
                break;
            case ResponseKey::right:
                if (waiting.turns_pages)
                    return {How::next, press->pressed_at, press->uncertainty};
                break;
            case ResponseKey::yes:
                return {How::yes, press->pressed_at, press->uncertainty};
            case ResponseKey::no:
                return {How::no, press->pressed_at, press->uncertainty};
            default:
                break;
            }
        }
        if (state_.ends_by_itself())
            return {How::session_over, state_.now()};
        // What is typed goes nowhere, and the screen would go on naming keys.
        if (const SessionTime began = state_.now(); await_keyboard()) {
            if (state_.is_over())
                return {How::session_over, state_.now()};
            const SessionTime shown_again = state_.show(waiting.screen);
            earliest += shown_again - began;
            latest = waiting.starts_over ? shown_again + from_seconds(waiting.max_s)
                                         : latest + (shown_again - began);
            await(shown_again);
            continue;
        }
        if (waiting.meanwhile)
            waiting.meanwhile();
        if (waiting.is_over)
            if (const std::optional<SessionTime> since = waiting.is_over())
                return {How::next, *since};
        rest_a_little(latest);
    }
    return {How::timed_out, latest};
}

bool OperatorControl::act_on(const ResponsePress& press) {
    const ResponseKey key = press.key;
    state_.log().event({press.pressed_at, state_.trial(), operator_pressed_event, std::string(name_of(key))});
    const SessionPhase phase = state_.phase();
    const int trial = state_.trial();
    switch (key) {
    case ResponseKey::pause:
        pause();
        break;
    case ResponseKey::recalibrate:
        if (confirm(state_.protocol.words.recalibrate))
            calibrate();
        break;
    case ResponseKey::drift_check:
        check_drift();
        break;
    case ResponseKey::repeat:
    case ResponseKey::reject:
    case ResponseKey::skip:
        if (!end_trial(key))
            return !state_.is_over();
        return false;
    case ResponseKey::abort:
        if (confirm(is_in_trial(phase) ? state_.protocol.words.abort_in_trial
                                       : state_.protocol.words.abort)) {
            state_.note(operator_event, "ends the session");
            state_.end_session("aborted by a key");
        }
        break;
    default:
        break;
    }
    if (state_.is_over())
        return false;
    if (state_.phase() != phase)
        state_.enter(phase, trial);
    return true;
}

/// Whether the trial is over.
bool OperatorControl::end_trial(ResponseKey key) {
    if (!is_in_trial(state_.phase())) {
        state_.note(operator_event, "a key for trials had no effect: none is running");
        return false;
    }
    const OperatorSettings& settings = state_.protocol.operators;
    const WordSettings& words = state_.protocol.words;
    if (key != ResponseKey::skip) {
        const bool at_once = key == ResponseKey::repeat;
        if (!confirm(at_once ? words.repeat : words.reject))
            return false;
        decision_ = {at_once ? TrialDecision::Kind::repeated : TrialDecision::Kind::rejected, {}};
        state_.note(operator_event, at_once ? "repeats the trial" : "rejects the trial");
        return true;
    }
    const std::optional<int> answer =
        confirm(screens::skip_question(state_.protocol), static_cast<int>(settings.skip_reasons.size()));
    if (!answer)
        return false;
    decision_ = {TrialDecision::Kind::skipped,
                 *answer == 0 ? "no reason given"
                              : settings.skip_reasons[static_cast<std::size_t>(*answer - 1)]};
    state_.note(operator_event, "skips the trial: " + decision_.why);
    return true;
}

std::optional<int> OperatorControl::confirm(const std::string& question, int reasons) {
    return confirm(screens::operator_question(state_.protocol, question), reasons);
}

std::optional<int> OperatorControl::confirm(const Screen& screen, int reasons) {
    state_.note(operator_asked_event, screen.text);
    const SessionTime onset = state_.show(screen);
    state_.ports.panel.await_decision(false, onset);
    std::optional<int> answer;
    for (bool is_decided = false; !is_decided && !state_.is_over() && !state_.ends_by_itself();) {
        while (const std::optional<ResponsePress> press = state_.ports.panel.poll()) {
            // A digit without a reason of that number is not taken for a yes.
            const int digit =
                press->key == ResponseKey::character && press->character >= U'1' && press->character <= U'9'
                    ? static_cast<int>(press->character - U'0')
                    : 0;
            if (press->key == ResponseKey::yes)
                answer = 0;
            else if (digit >= 1 && digit <= reasons)
                answer = digit;
            else if (press->key != ResponseKey::no && press->key != ResponseKey::abort)
                continue;
            is_decided = true;
            break;
        }
        if (!is_decided && await_keyboard() && !state_.is_over())
            state_.ports.panel.await_decision(false, state_.show(screen));
        if (!is_decided)
            rest_a_little(SessionTime::max());
    }
    state_.note(operator_answered_event, answer ? "yes" : "no");
    return state_.is_over() ? std::nullopt : answer;
}

bool OperatorControl::await_keyboard() {
    // Who ends the session meanwhile, at another device, is asked whether that is meant.
    if (is_awaiting_keyboard_ || state_.ports.panel.has_keyboard())
        return false;
    is_awaiting_keyboard_ = true;
    const SessionPhase phase = state_.phase();
    const int trial = state_.trial();
    state_.enter(SessionPhase::pause, trial);
    const Screen screen = screens::keyboard_lost(state_.protocol);
    state_.ports.panel.await_key(state_.show(screen));
    while (!state_.is_over() && !state_.ports.panel.has_keyboard() && !state_.ends_by_itself()) {
        while (const std::optional<ResponsePress> press = state_.ports.panel.poll()) {
            if (press->key == ResponseKey::abort && act_on(*press))
                state_.ports.panel.await_key(state_.show(screen));
            if (state_.is_over())
                break;
        }
        if (!state_.is_over())
            rest_a_little(SessionTime::max());
    }
    is_awaiting_keyboard_ = false;
    if (!state_.is_over())
        state_.enter(phase, trial);
    return true;
}

std::vector<std::string> OperatorControl::note_screen_changes() {
    std::vector<std::string> changes;
    if (state_.ports.screen_changes)
        changes = state_.ports.screen_changes();
    for (const std::string& change : changes)
        state_.note(screen_changed_event, change);
    return changes;
}

void OperatorControl::look_at_screen() {
    const std::vector<std::string> changes = note_screen_changes();
    if (changes.empty() || state_.is_over())
        return;
    std::string question = state_.protocol.words.screen_changed;
    for (const std::string& change : changes)
        question += "\n" + change;
    const bool goes_on = confirm(question).has_value();
    if (state_.is_over())
        return;
    state_.note(operator_event, goes_on ? "goes on with a screen that has changed"
                                        : "ends the session: the screen has changed");
    if (!goes_on)
        state_.end_session("the screen changed: " + changes.front());
}

void OperatorControl::pause() {
    state_.note(operator_event, "pauses");
    state_.enter(SessionPhase::pause, state_.trial());
    const Screen screen = screens::pause(state_.protocol);
    const SessionTime onset = state_.show(screen);
    state_.ports.panel.await_key(onset);
    for (bool goes_on = false; !goes_on && !state_.is_over() && !state_.ends_by_itself();) {
        while (const std::optional<ResponsePress> press = state_.ports.panel.poll()) {
            // The observer's key does not end the operator's pause.
            if (press->key == ResponseKey::pause) {
                state_.log().event({press->pressed_at, state_.trial(), operator_pressed_event, "pause"});
                goes_on = true;
                break;
            }
            if (press->key == ResponseKey::abort || press->key == ResponseKey::recalibrate) {
                if (!act_on(*press))
                    return;
                state_.ports.panel.await_key(state_.show(screen));
            }
        }
        if (!goes_on && await_keyboard() && !state_.is_over())
            state_.ports.panel.await_key(state_.show(screen));
        if (!goes_on)
            rest_a_little(SessionTime::max());
    }
    state_.note(operator_event, fmt::format("goes on after {:.1f} s", to_seconds(state_.now() - onset)));
}

namespace {

/// A question about a tracker; of several, the further ones are named.
std::string about(const UsedTracker& used, const std::string& question) {
    return used.is_further() ? used.id + ": " + question : question;
}

/// A question with what is known of its reason below it.
std::string with_reason(std::string question, const std::string& why) {
    return why.empty() ? question : question + "\n" + why;
}

} // namespace

void OperatorControl::begin_calibration() {
    if (state_.phase() != SessionPhase::calibration)
        state_.enter(SessionPhase::calibration, state_.trial());
    // An empty screen would look like a session that has stopped.
    state_.show(screens::please_wait(state_.protocol));
}

void OperatorControl::calibrate() {
    for (UsedTracker& used : state_.trackers()) {
        if (state_.is_over())
            return;
        if (used.is_left_out) {
            begin_calibration();
            try {
                used.tracker.reconnect();
                used.is_left_out = false;
                state_.note_of(used, tracker_regained_event, used.tracker.description().model);
            } catch (const DeviceError& error) {
                state_.note_of(used, tracker_lost_event, error.what());
                continue;
            }
        }
        calibrate(used);
    }
}

void OperatorControl::calibrate(UsedTracker& used) {
    begin_calibration();
    if (!used.tracker.measures_gaze()) {
        state_.note("calibration", "none: the session has no eye tracker");
        return;
    }
    SessionSetupScreen setup_screen(state_);
    while (!state_.ends_by_itself()) {
        SetupOutcome outcome;
        try {
            outcome = used.tracker.set_up(setup_screen);
        } catch (const DeviceError& error) {
            if (!connect_again(used, error.what()))
                return;
            continue;
        }
        if (outcome.kind == SetupOutcome::Kind::done) {
            if (accepts(used, outcome))
                return;
            continue;
        }
        state_.note_of(used, calibration_failed_event, outcome.message);
        if (state_.ends_by_itself())
            return;
        if (!confirm(with_reason(about(used, state_.protocol.words.not_calibrated), outcome.message))) {
            give_up(used, "the eye tracker was not calibrated");
            return;
        }
    }
}

/// Records what the validation found. What is too poor by the protocol, or was calibrated by the program, is
/// shown to the operator, who decides.
bool OperatorControl::accepts(UsedTracker& used, const SetupOutcome& outcome) {
    const CalibrationKeys& limits = state_.protocol.calibration;
    const WordSettings& words = state_.protocol.words;
    if (!outcome.validation) {
        state_.note_of(used, calibrated_event, outcome.message);
        return true;
    }
    const ValidationResult& found = *outcome.validation;
    state_.note_of(used, validation_event,
                   fmt::format("mean error {:.3f} deg, largest {:.3f} deg", found.mean_error.value,
                               found.max_error.value));
    const bool is_good =
        found.mean_error.value <= limits.mean_limit_deg && found.max_error.value <= limits.max_limit_deg;
    if (!is_good || !used.tracker.calibrates_itself()) {
        const std::optional<int> goes_on = confirm(screens::validation(
            state_.protocol, found, about(used, is_good ? words.validation : words.validation_poor)));
        if (!goes_on)
            return false;
        if (!is_good)
            state_.note_of(used, operator_event,
                           "goes on with a validation that is poorer than the protocol allows");
    }
    state_.log_of(used).calibration({state_.now(), state_.trial(), outcome.method, found, is_good});
    return true;
}

void OperatorControl::check_drift() {
    EyeTracker& tracker = state_.ports.tracker;
    if (!tracker.measures_gaze()) {
        state_.note(operator_event, "a drift check had no effect: the session has no eye tracker");
        return;
    }
    const SessionTime onset = state_.show({.kind = Screen::Kind::target, .text = ""});
    const SessionTime latest = onset + from_seconds(state_.protocol.screens.drift_target_s);
    while (state_.now() < latest && !state_.ends_by_itself())
        rest_a_little(latest);
    if (state_.is_over())
        return;
    try {
        const DriftOutcome drift = tracker.drift_check(screen_geometry_of(state_.protocol).centre());
        if (drift.kind == DriftOutcome::Kind::set_up_wanted) {
            state_.note_of(state_.own_tracker(), drift_check_failed_event, "the tracker asked to be set up");
            calibrate(state_.own_tracker());
        } else if (drift.kind == DriftOutcome::Kind::measured) {
            state_.note_of(state_.own_tracker(), drift_checked_event,
                           fmt::format("{:.3f} deg", drift.error.value));
        } else {
            state_.note_of(state_.own_tracker(), drift_check_failed_event, "no eye was found");
        }
    } catch (const DeviceError& error) {
        regain_tracker(error.what());
    }
}

/// The session does not go on without its own tracker, and goes on without a further one.
void OperatorControl::give_up(UsedTracker& used, const std::string& why) {
    if (!used.is_further()) {
        state_.end_session(why);
        return;
    }
    used.is_left_out = true;
    state_.note_of(used, tracker_event, "is left out from here on, until it is calibrated again: " + why);
}

/// Until it is reached; false: it was given up, or the session is over.
bool OperatorControl::connect_again(UsedTracker& used, std::string why) {
    if (!std::exchange(used.is_lost, false))
        state_.note_of(used, tracker_lost_event, why);
    while (!state_.is_over()) {
        if (!confirm(with_reason(about(used, state_.protocol.words.tracker_lost), why))) {
            give_up(used, "the eye tracker was lost");
            return false;
        }
        try {
            used.tracker.reconnect();
            state_.note_of(used, tracker_regained_event, used.tracker.description().model);
            return true;
        } catch (const DeviceError& error) {
            why = error.what();
            state_.note_of(used, tracker_lost_event, why);
        }
    }
    return false;
}

void OperatorControl::regain_tracker(const std::string& why) {
    const SessionPhase phase = state_.phase();
    const int trial = state_.trial();
    if (!connect_again(state_.own_tracker(), why))
        return;
    calibrate(state_.own_tracker());
    if (!state_.is_over() && state_.phase() != phase)
        state_.enter(phase, trial);
}

void OperatorControl::regain_further_trackers() {
    for (UsedTracker& used : state_.trackers())
        if (used.is_further() && !used.is_left_out && (used.is_lost || used.tracker.lost()) &&
            !state_.is_over() && connect_again(used, used.is_lost ? used.why_lost : "between trials"))
            calibrate(used);
}

} // namespace overt
