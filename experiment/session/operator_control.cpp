#include "experiment/session/operator_control.h"
#include "experiment/ports/event_kinds.h"
#include "experiment/ports/eye_tracker.h"
#include "experiment/ports/presenter.h"
#include "experiment/ports/response_panel.h"
#include "experiment/ports/session_phase.h"
#include "experiment/session/session_screens.h"

#include <algorithm>

#include <fmt/format.h>

namespace overt {

namespace {

using ResponseKey = ResponsePress::Key;

} // namespace

void OperatorControl::rest_a_little(SessionTime latest) {
    state_.ports.presenter.use_spare_time();
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
                return {How::next, press->pressed_at};
            case ResponseKey::back:
            case ResponseKey::left:
                if (waiting.turns_pages)
                    return {How::back, press->pressed_at};
                break;
            case ResponseKey::right:
                if (waiting.turns_pages)
                    return {How::next, press->pressed_at};
                break;
            case ResponseKey::yes:
                return {How::yes, press->pressed_at};
            case ResponseKey::no:
                return {How::no, press->pressed_at};
            default:
                break;
            }
        }
        if (state_.ends_by_itself())
            return {How::session_over, state_.now()};
        if (waiting.meanwhile)
            waiting.meanwhile();
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
        decision_ = {at_once ? TrialDecision::Word::repeated : TrialDecision::Word::rejected, {}};
        state_.note(operator_event, at_once ? "repeats the trial" : "rejects the trial");
        return true;
    }
    const std::optional<int> answer =
        confirm(screens::skip_question(state_.protocol), static_cast<int>(settings.skip_reasons.size()));
    if (!answer)
        return false;
    decision_ = {TrialDecision::Word::skipped,
                 *answer == 0 ? "no reason given"
                              : settings.skip_reasons[static_cast<std::size_t>(*answer - 1)]};
    state_.note(operator_event, "skips the trial: " + decision_.why);
    return true;
}

std::optional<int> OperatorControl::confirm(const std::string& question, int reasons) {
    state_.note(operator_asked_event, question);
    const SessionTime onset = state_.show(screens::operator_question(state_.protocol, question));
    state_.ports.panel.await_decision(false, onset);
    std::optional<int> answer;
    for (bool is_decided = false; !is_decided && !state_.ends_by_itself();) {
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
        if (!is_decided)
            rest_a_little(SessionTime::max());
    }
    state_.note(operator_answered_event, answer ? "yes" : "no");
    return state_.is_over() ? std::nullopt : answer;
}

void OperatorControl::pause() {
    state_.note(operator_event, "pauses");
    state_.enter(SessionPhase::pause, state_.trial());
    const Screen screen = screens::pause(state_.protocol);
    const SessionTime onset = state_.show(screen);
    state_.ports.panel.await_key(onset);
    for (bool goes_on = false; !goes_on && !state_.ends_by_itself();) {
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
        if (!goes_on)
            rest_a_little(SessionTime::max());
    }
    state_.note(operator_event, fmt::format("goes on after {:.1f} s", to_seconds(state_.now() - onset)));
}

void OperatorControl::calibrate() {
    if (state_.phase() != SessionPhase::calibration)
        state_.enter(SessionPhase::calibration, state_.trial());
    // An empty screen would look like a session that has stopped.
    state_.show(screens::please_wait(state_.protocol));
    if (!state_.ports.tracker.measures_gaze()) {
        state_.note("calibration", "none: the session has no eye tracker");
        return;
    }
    const ValidationResult result = state_.ports.tracker.calibrate();
    state_.note(validation_event, fmt::format("mean error {:.3f} deg, largest {:.3f} deg",
                                              result.mean_error.value, result.max_error.value));
}

} // namespace overt
