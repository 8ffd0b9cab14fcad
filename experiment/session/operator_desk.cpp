#include "experiment/session/operator_desk.h"

#include <algorithm>

#include <fmt/format.h>

#include "experiment/ports/event_kinds.h"
#include "experiment/ports/operator_key.h"

namespace overt {

namespace {

/// How often the keys are looked at while a screen stands still.
constexpr SessionDuration key_interval = std::chrono::milliseconds(4);

using Key = ResponsePress::Key;

std::string upper(std::string key) {
    for (char& letter : key)
        letter = static_cast<char>(letter >= 'a' && letter <= 'z' ? letter - 'a' + 'A' : letter);
    return key;
}

} // namespace

void OperatorDesk::rest_a_little(SessionTime latest) {
    stage_.ports.presenter.use_spare_time();
    stage_.ports.clock.wait_until(std::min(latest, stage_.now() + key_interval));
}

OperatorDesk::Press OperatorDesk::wait(const Waiting& waiting) {
    SessionTime earliest = waiting.onset + from_seconds(waiting.min_s);
    SessionTime latest = waiting.onset + from_seconds(waiting.max_s);
    const auto await = [&](SessionTime since) {
        if (waiting.await)
            waiting.await(since);
        else
            stage_.ports.panel.await_key(since);
    };
    await(waiting.onset);
    while (stage_.now() < latest) {
        while (const std::optional<ResponsePress> press = stage_.ports.panel.poll()) {
            if (is_operators(press->key)) {
                const SessionTime began = stage_.now();
                if (!act_on(*press))
                    return {stage_.is_over() ? How::session_over : How::trial_over, press->pressed_at};
                const SessionTime shown_again = stage_.show(waiting.screen);
                earliest += shown_again - began;
                latest = waiting.starts_over ? shown_again + from_seconds(waiting.max_s)
                                             : latest + (shown_again - began);
                await(shown_again);
                continue;
            }
            if (!waiting.takes_keys || press->pressed_at < earliest)
                continue;
            switch (press->key) {
            case Key::next:
                return {How::next, press->pressed_at};
            case Key::back:
            case Key::left:
                if (waiting.turns_pages)
                    return {How::back, press->pressed_at};
                break;
            case Key::right:
                if (waiting.turns_pages)
                    return {How::next, press->pressed_at};
                break;
            case Key::yes:
                return {How::yes, press->pressed_at};
            case Key::no:
                return {How::no, press->pressed_at};
            default:
                break;
            }
        }
        if (stage_.ends_by_itself())
            return {How::session_over, stage_.now()};
        if (waiting.meanwhile)
            waiting.meanwhile();
        rest_a_little(latest);
    }
    return {How::timed_out, latest};
}

bool OperatorDesk::act_on(const ResponsePress& press) {
    const Key key = press.key;
    stage_.log().event({press.pressed_at, stage_.trial(), operator_pressed_event, std::string(name_of(key))});
    const SessionPhase phase = stage_.phase();
    const int trial = stage_.trial();
    switch (key) {
    case Key::pause:
        pause();
        break;
    case Key::recalibrate:
        if (confirm(stage_.protocol.words.recalibrate))
            calibrate();
        break;
    case Key::repeat:
    case Key::reject:
    case Key::skip:
        if (!end_trial(key))
            return !stage_.is_over();
        return false;
    case Key::abort:
        if (confirm(is_in_trial(phase) ? stage_.protocol.words.abort_in_trial
                                       : stage_.protocol.words.abort)) {
            stage_.note(operator_event, "ends the session");
            stage_.end_session("aborted by a key");
        }
        break;
    default:
        break;
    }
    if (stage_.is_over())
        return false;
    if (stage_.phase() != phase)
        stage_.enter(phase, trial);
    return true;
}

/// Whether the trial is over.
bool OperatorDesk::end_trial(Key key) {
    if (!is_in_trial(stage_.phase())) {
        stage_.note(operator_event, "a key for trials had no effect: none is running");
        return false;
    }
    const OperatorSettings& settings = stage_.protocol.operators;
    const WordSettings& words = stage_.protocol.words;
    if (key != Key::skip) {
        const bool at_once = key == Key::repeat;
        if (!confirm(at_once ? words.repeat : words.reject))
            return false;
        decision_ = {at_once ? TrialDecision::Word::repeated : TrialDecision::Word::rejected, {}};
        stage_.note(operator_event, at_once ? "repeats the trial" : "rejects the trial");
        return true;
    }
    std::string question = words.skip;
    for (std::size_t i = 0; i < settings.skip_reasons.size(); ++i)
        question +=
            fmt::format("{}{}: {}, {}", i == 0 ? "\n\n" : "\n", i + 1, words.yes, settings.skip_reasons[i]);
    const std::optional<int> answer = confirm(question, static_cast<int>(settings.skip_reasons.size()));
    if (!answer)
        return false;
    decision_ = {TrialDecision::Word::skipped,
                 *answer == 0 ? "no reason given"
                              : settings.skip_reasons[static_cast<std::size_t>(*answer - 1)]};
    stage_.note(operator_event, "skips the trial: " + decision_.why);
    return true;
}

std::optional<int> OperatorDesk::confirm(const std::string& question, int reasons) {
    const OperatorSettings& keys = stage_.protocol.operators;
    stage_.note(operator_asked_event, question);
    const WordSettings& words = stage_.protocol.words;
    const SessionTime onset =
        stage_.show({Screen::Kind::text, fmt::format("{}\n\n{}: {}        {}: {}", question, upper(keys.yes),
                                                     words.yes, upper(keys.no), words.no)});
    stage_.ports.panel.await_decision(false, onset);
    std::optional<int> answer;
    for (bool is_decided = false; !is_decided && !stage_.ends_by_itself();) {
        while (const std::optional<ResponsePress> press = stage_.ports.panel.poll()) {
            // A digit that stands for no reason is no yes, to whatever question.
            const int digit =
                press->key == Key::character && press->character >= U'1' && press->character <= U'9'
                    ? static_cast<int>(press->character - U'0')
                    : 0;
            if (press->key == Key::yes)
                answer = 0;
            else if (digit >= 1 && digit <= reasons)
                answer = digit;
            else if (press->key != Key::no && press->key != Key::abort)
                continue;
            is_decided = true;
            break;
        }
        if (!is_decided)
            rest_a_little(SessionTime::max());
    }
    stage_.note(operator_answered_event, answer ? "yes" : "no");
    return stage_.is_over() ? std::nullopt : answer;
}

void OperatorDesk::pause() {
    stage_.note(operator_event, "pauses");
    stage_.enter(SessionPhase::pause, stage_.trial());
    const SessionTime onset = stage_.show({Screen::Kind::text, stage_.protocol.operators.pause_text});
    stage_.ports.panel.await_key(onset);
    for (bool goes_on = false; !goes_on && !stage_.ends_by_itself();) {
        while (const std::optional<ResponsePress> press = stage_.ports.panel.poll()) {
            // The observer's key does not end the operator's pause.
            if (press->key == Key::pause) {
                stage_.log().event({press->pressed_at, stage_.trial(), operator_pressed_event, "pause"});
                goes_on = true;
                break;
            }
            if (press->key == Key::abort || press->key == Key::recalibrate) {
                if (!act_on(*press))
                    return;
                stage_.ports.panel.await_key(
                    stage_.show({Screen::Kind::text, stage_.protocol.operators.pause_text}));
            }
        }
        if (!goes_on)
            rest_a_little(SessionTime::max());
    }
    stage_.note(operator_event, fmt::format("goes on after {:.1f} s", to_seconds(stage_.now() - onset)));
}

void OperatorDesk::calibrate() {
    if (stage_.phase() != SessionPhase::calibration)
        stage_.enter(SessionPhase::calibration, stage_.trial());
    stage_.show({});
    const ValidationResult result = stage_.ports.tracker.calibrate();
    stage_.note(validation_event, fmt::format("mean error {:.3f} deg, largest {:.3f} deg",
                                              result.mean_error.value, result.max_error.value));
}

} // namespace overt
