#include "devices/simulated/simulated_response_panel.h"

#include <utility>

#include <fmt/format.h>

#include "experiment/ports/session_log.h"

namespace overt {

namespace {

using Key = ResponsePress::Key;

constexpr SessionDuration pressed_again_after = std::chrono::seconds(1);
constexpr SessionDuration operators_decision = std::chrono::seconds(1);
constexpr SessionDuration operators_pause = std::chrono::seconds(5);
constexpr int most_own_decisions = 5;

} // namespace

SimulatedResponsePanel::SimulatedResponsePanel(const Clock& clock, const SimulatedObserver& observer,
                                               const std::vector<ScriptedOperatorKey>& script,
                                               const SimulatedAnswers* answers)
    : clock_(&clock), observer_(&observer), answers_(answers) {
    for (const ScriptedOperatorKey& key : script)
        operators_.push_back({.scripted = key});
    keys_.let_gaze_guide([observer = observer_](SessionTime at) {
        const ScreenPoint gaze = observer->gaze_at(at).place, middle = observer->scene().screen.centre();
        return glm::dvec2(gaze.x_px - middle.x_px, gaze.y_px - middle.y_px);
    });
}

void SimulatedResponsePanel::await(Awaited what, SessionTime since, const Trial* trial) {
    pressed_on_.waits_for(what);
    keys_.clear();
    awaited_ = what;
    for (Operator& one : operators_)
        one.is_answering = false; // what was left of it answered something else
    if (what == Awaited::answer) {
        next_press_.reset();
        asked_in_ = trial;
        offer(std::move(offers_));
        keys_.awaited(since);
        return;
    }
    if (what == Awaited::decision) {
        next_press_ = since + operators_decision;
        // To what is asked without a key, such as whether a calibration is good enough, yes; but not for
        // ever.
        if (!operators_answer_)
            operators_answer_ = ++own_decisions_ <= most_own_decisions ? U'y' : U'n';
        pressed_with_.character = *std::exchange(operators_answer_, std::nullopt);
        pressed_with_.key = pressed_with_.character == U'y'   ? Key::yes
                            : pressed_with_.character == U'n' ? Key::no
                                                              : Key::character;
        return;
    }
    pressed_with_.key = what == Awaited::consent ? Key::yes : Key::next;
    if (what == Awaited::response) {
        SimulatedAnswer answer = observer_->answer_to(*trial);
        next_press_ = since + answer.after;
        answer_ = std::move(answer.text);
    } else {
        next_press_ = since + observer_->reading_time(texts_read_++);
        answer_.clear();
    }
}

void SimulatedResponsePanel::offer(const std::vector<AnswerOffer>& answers) {
    std::vector<AnswerOffer> offered = answers;
    offers_ = std::move(offered);
    if (answers_ && asked_in_)
        keys_.plan(*answers_, offers_, *asked_in_);
}

void SimulatedResponsePanel::offer_turning(const TurningOffer& turning) {
    if (answers_ && asked_in_)
        turns_.plan(answers_->seed(), *asked_in_, turning);
}

void SimulatedResponsePanel::entered(SessionPhase phase, int trial) noexcept {
    // A trial that comes again and again, since its tracker stays lost, is no headway.
    if (phase == SessionPhase::trial && trial > furthest_trial_) {
        furthest_trial_ = trial;
        own_decisions_ = 0;
    }
    if (phase == SessionPhase::trial) {
        asked_in_ = nullptr; // the one before is over
        turns_.clear();
    }
    pressed_on_.entered(phase, trial);
    // A pause that has ended by itself, since the keyboard is back, needs no key.
    if (phase != SessionPhase::pause)
        resumes_at_.reset();
    else if (!resumes_at_)
        resumes_at_ = clock_->now() + operators_pause;
    for (Operator& one : operators_) {
        const ScriptedOperatorKey& scripted = one.scripted;
        if (!one.due && scripted.phase == phase && (!scripted.trial || *scripted.trial == trial))
            one.due = clock_->now() + from_seconds(scripted.after_s);
    }
}

std::vector<std::string> SimulatedResponsePanel::closing_warnings() const {
    std::vector<std::string> warnings;
    for (const Operator& one : operators_)
        if (!one.is_done)
            warnings.push_back(
                fmt::format("--simulate-operator {}: was not pressed: the session had no such moment",
                            one.scripted.text));
    return warnings;
}

void SimulatedResponsePanel::note(SessionTime at, const ScriptedOperatorKey* scripted,
                                  bool goes_on) noexcept {
    if (const std::optional<SessionPhase> screen = pressed_on_.screen();
        screen && noted_count_ < noted_.size())
        noted_[noted_count_++] = {at, *screen, pressed_on_.trial(), scripted, goes_on};
}

void SimulatedResponsePanel::write_down(SessionLog& log) {
    if (noted_count_ == 0)
        return;
    std::vector<RecordedKeyPress> presses;
    for (std::size_t i = 0; i < noted_count_; ++i) {
        const Noted& noted = noted_[i];
        presses.push_back({.at = noted.at,
                           .trial = noted.trial,
                           .device = std::string(simulated_observer_device),
                           .name = noted.scripted ? noted.scripted->pressed : "space",
                           .screen = noted.screen,
                           .meaning = noted.goes_on && goes_on_at(noted.screen) ? "next" : ""});
    }
    noted_count_ = 0;
    log.key_presses(presses);
}

std::optional<ResponsePress> SimulatedResponsePanel::scripted_press() noexcept {
    const SessionTime now = clock_->now();
    if (resumes_at_ && now >= *resumes_at_) {
        const ResponsePress press{Key::pause, *resumes_at_};
        resumes_at_.reset();
        return press;
    }
    for (Operator& one : operators_) {
        if (!one.due || one.is_done || now < *one.due)
            continue;
        one.is_done = true;
        if (one.scripted.is_observers()) {
            one.is_answering = awaited_ == Awaited::answer;
            const bool is_key = !one.scripted.pressed.empty();
            const bool goes_on = is_key && !one.is_answering && one.scripted.key == Key::next;
            if (is_key)
                note(*one.due, &one.scripted, goes_on);
            if (goes_on)
                return ResponsePress{Key::next, *one.due};
            continue;
        }
        operators_answer_ = one.scripted.answer;
        return ResponsePress{one.scripted.key, *one.due};
    }
    return std::nullopt;
}

std::optional<ObserverInput> SimulatedResponsePanel::next_input() noexcept {
    const SessionTime now = clock_->now();
    const auto next_at = [](const Operator& one) {
        return *one.due + one.scripted.inputs[one.inputs_told].after;
    };
    Operator* earliest = nullptr;
    for (Operator& one : operators_)
        if (one.is_answering && one.inputs_told < one.scripted.inputs.size() && next_at(one) <= now &&
            (!earliest || next_at(one) < next_at(*earliest)))
            earliest = &one;
    if (!earliest) {
        const std::optional<ObserverInput> turn = turns_.next(now);
        return turn ? turn : keys_.next(now);
    }
    ObserverInput input = earliest->scripted.inputs[earliest->inputs_told].input;
    input.at = next_at(*earliest);
    ++earliest->inputs_told;
    return input;
}

std::optional<ResponsePress> SimulatedResponsePanel::poll() noexcept {
    if (const std::optional<ResponsePress> press = scripted_press())
        return press;
    if (!next_press_ || clock_->now() < *next_press_)
        return std::nullopt;
    ResponsePress press = pressed_with_;
    press.pressed_at = *next_press_;
    // What it presses because nobody asked it otherwise is no key at a stimulus.
    if (press.key == Key::next && pressed_on_.screen() && goes_on_at(*pressed_on_.screen()))
        note(press.pressed_at, nullptr, true);
    next_press_ = *next_press_ + pressed_again_after;
    return press;
}

} // namespace overt
