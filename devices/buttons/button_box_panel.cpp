#include "devices/buttons/button_box_panel.h"

#include <algorithm>

#include <fmt/format.h>

#include "experiment/base/counted.h"
#include "experiment/base/error.h"
#include "experiment/ports/event_kinds.h"
#include "experiment/ports/session_log.h"

namespace overt {
namespace {

using Key = ResponsePress::Key;

/// Keys of keyboards have the highest: 256 and a byte.
constexpr int most_buttons = 512;
constexpr std::size_t most_changes = 4096;

constexpr bool decides(Key key) { return key == Key::yes || key == Key::no || key == Key::character; }

std::string_view word_of(bool is_operators) { return is_operators ? "operator" : "observer"; }

} // namespace

ButtonBoxPanel::ButtonBoxPanel(std::vector<BoxInHand> boxes, const Clock& clock, ResponsePanel* answering,
                               std::function<void(const std::string&)> tell)
    : clock_(&clock), answering_(answering), tell_(std::move(tell)) {
    goes_on_.words = "next";
    changes_.reserve(most_changes);
    recorded_.reserve(most_changes);
    for (BoxInHand& box : boxes) {
        Hand hand{std::move(box), std::vector<int>(most_buttons, -1)};
        for (int number = 0; number < most_buttons; ++number)
            hand.names.emplace_back(hand.in_hand.box->button_name(number));
        const std::vector<ButtonMeaning>& meanings = hand.in_hand.meanings;
        for (std::size_t i = 0; i < meanings.size(); ++i) {
            // A digit is the name of a button and of a key: whichever the box has.
            bool is_there = false;
            for (int number = 0; number < most_buttons; ++number) {
                if (hand.names[static_cast<std::size_t>(number)] != ShortName(meanings[i].button))
                    continue;
                hand.meaning_of[static_cast<std::size_t>(number)] = static_cast<int>(i);
                is_there = true;
            }
            if (!is_there)
                throw InputError(fmt::format("[[button_box]] \"{}\": {} boxes have no button \"{}\"; "
                                             "docs/devices.md has their names",
                                             hand.in_hand.id, hand.in_hand.box->description().name,
                                             meanings[i].button));
        }
        hands_.push_back(std::move(hand));
    }
}

const ButtonMeaning* ButtonBoxPanel::meaning(const Hand& hand, int button) const noexcept {
    if (hand.in_hand.meanings.empty())
        return hand.in_hand.is_operators ? nullptr : &goes_on_;
    if (button < 0 || button >= most_buttons)
        return nullptr;
    const int index = hand.meaning_of[static_cast<std::size_t>(button)];
    return index < 0 ? nullptr : &hand.in_hand.meanings[static_cast<std::size_t>(index)];
}

/// What a change says where the session is now.
std::optional<ResponsePress> ButtonBoxPanel::press_of(const Hand& hand, const ButtonChange& change) noexcept {
    const ButtonMeaning* const means = change.is_down ? meaning(hand, change.button) : nullptr;
    if (!means)
        return std::nullopt;
    const ResponsePress press{means->key, change.at, means->character};
    if (hand.in_hand.is_operators) {
        if (decides(means->key))
            return awaited_ == Awaited::decision ? std::optional(press) : std::nullopt;
        return press;
    }
    // What was pressed before the text or the question stood there does not answer it.
    if (change.at < since_)
        return std::nullopt;
    switch (awaited_) {
    case Awaited::key:
        return decides(means->key) ? std::nullopt : std::optional(press);
    case Awaited::response:
        if (means->key != Key::next)
            return std::nullopt;
        answered_ = means;
        box_answered_ = true;
        return press;
    case Awaited::consent:
        return means->key == Key::yes || means->key == Key::no ? std::optional(press) : std::nullopt;
    case Awaited::decision: // the operator's
    case Awaited::entry:    // letters are typed
    case Awaited::setup:
    case Awaited::answer: // told by next_input()
        break;
    }
    return std::nullopt;
}

/// What the boxes did and is not recorded yet.
bool ButtonBoxPanel::next_change(Change& into) noexcept {
    for (std::size_t i = 0; i < hands_.size(); ++i) {
        into.hand = i;
        into.trial = trial_;
        into.screen = pressed_on_.screen();
        if (hands_[i].in_hand.box->poll(into.change))
            return true;
    }
    return false;
}

/// What a knob did stands in the record with what it moved.
void ButtonBoxPanel::keep(const Change& change) noexcept {
    if (change.change.is_turn())
        return;
    if (changes_.size() < changes_.capacity())
        changes_.push_back(change);
    else
        ++unrecorded_;
}

std::optional<ResponsePress> ButtonBoxPanel::next_press() noexcept {
    // What was recorded before anybody asked comes first.
    std::size_t told = 0;
    std::optional<ResponsePress> press;
    while (!press && told < recorded_.size()) {
        const Change& change = recorded_[told++];
        note_input(change);
        press = press_of(hands_[change.hand], change.change);
    }
    recorded_.erase(recorded_.begin(), recorded_.begin() + static_cast<std::ptrdiff_t>(told));
    for (Change change; !press && next_change(change);) {
        keep(change);
        note_input(change);
        press = press_of(hands_[change.hand], change.change);
    }
    return press;
}

/// What an observer's button did since an answer is awaited.
void ButtonBoxPanel::note_input(const Change& change) noexcept {
    const Hand& hand = hands_[change.hand];
    if (change.change.is_turn())
        return note_turn(change);
    const int button = change.change.button;
    if (awaited_ != Awaited::answer || hand.in_hand.is_operators || change.change.at < since_ || button < 0 ||
        button >= most_buttons || input_count_ == inputs_.size())
        return;
    inputs_[input_count_++] = {.kind = change.change.is_down ? ObserverInput::Kind::key_down
                                                             : ObserverInput::Kind::key_up,
                               .at = change.change.at,
                               .uncertainty = change.change.uncertainty,
                               .device = ShortName(hand.in_hand.id),
                               .key = hand.names[static_cast<std::size_t>(button)]};
}

/// Each of its axes by itself.
void ButtonBoxPanel::note_turn(const Change& change) noexcept {
    const Hand& hand = hands_[change.hand];
    if (awaited_ != Awaited::answer || hand.in_hand.is_operators || change.change.at < since_)
        return;
    ObserverInput input{.at = change.change.at,
                        .uncertainty = change.change.uncertainty,
                        .device = ShortName(hand.in_hand.id)};
    const auto add = [&](ObserverInput::Kind kind, int steps) {
        input.kind = kind;
        input.steps = steps;
        if (steps != 0 && input_count_ < inputs_.size())
            inputs_[input_count_++] = input;
    };
    add(ObserverInput::Kind::dial, change.change.turn_steps);
    add(ObserverInput::Kind::tilt, change.change.tilt_steps);
}

std::optional<ObserverInput> ButtonBoxPanel::next_input() noexcept {
    if (input_count_ == 0)
        return answering_ ? answering_->next_input() : std::nullopt;
    const ObserverInput input = inputs_[0];
    std::copy(inputs_.begin() + 1, inputs_.begin() + static_cast<std::ptrdiff_t>(input_count_),
              inputs_.begin());
    --input_count_;
    return input;
}

/// The operator's presses stay, and all are recorded.
void ButtonBoxPanel::await(Awaited what, SessionTime since, const Trial* trial) {
    while (const std::optional<ResponsePress> press = next_press())
        if (is_operators(press->key) && kept_count_ < kept_.size())
            kept_[kept_count_++] = *press;
    pressed_on_.waits_for(what);
    awaited_ = what;
    since_ = since;
    input_count_ = 0;
    box_answered_ = false;
    answered_ = nullptr;
    if (answering_)
        answering_->await(what, since, trial);
}

std::optional<ResponsePress> ButtonBoxPanel::poll() noexcept {
    if (kept_count_ > 0) {
        const ResponsePress press = kept_[0];
        std::copy(kept_.begin() + 1, kept_.begin() + static_cast<std::ptrdiff_t>(kept_count_), kept_.begin());
        --kept_count_;
        return press;
    }
    if (const std::optional<ResponsePress> press = next_press())
        return press;
    const std::optional<ResponsePress> press = answering_ ? answering_->poll() : std::nullopt;
    if (press && !is_operators(press->key))
        box_answered_ = false;
    return press;
}

std::string ButtonBoxPanel::answer() {
    if (box_answered_)
        return answered_ ? answered_->answer : std::string();
    return answering_ ? answering_->answer() : std::string();
}

void ButtonBoxPanel::entered(SessionPhase phase, int trial) noexcept {
    trial_ = trial;
    pressed_on_.entered(phase, trial);
    // Between trials there is time to read the boxes' clocks.
    if (phase == SessionPhase::trial || !is_in_trial(phase))
        for (const Hand& hand : hands_)
            hand.in_hand.box->begin();
    if (answering_)
        answering_->entered(phase, trial);
}

void ButtonBoxPanel::write_news(SessionLog& log, Hand& hand) {
    const std::string& id = hand.in_hand.id;
    for (const BoxNews& news : hand.in_hand.box->take_news()) {
        hand.losses += news.is_lost ? 1 : 0;
        log.event({news.at, trial_, news.is_lost ? response_box_lost_event : response_box_regained_event,
                   fmt::format("{}: {}", id, news.words)});
        tell_(news.is_lost
                  ? fmt::format(
                        "the response box \"{}\" does not answer any more: see to its cable; it is looked "
                        "for, and the keyboard goes on working",
                        id)
                  : fmt::format("the response box \"{}\" is there again", id));
    }
}

void ButtonBoxPanel::write_down(SessionLog& log) {
    for (Hand& hand : hands_) {
        if (!hand.is_noted) {
            const ButtonBoxDescription& box = hand.in_hand.box->description();
            log.event({clock_->now(), -1, response_box_event,
                       fmt::format("{}: {}, of the {}, {}", hand.in_hand.id, box.model,
                                   word_of(hand.in_hand.is_operators),
                                   box.has_clock ? "with a clock of its own"
                                                 : "without a clock: times are those of arrival")});
            hand.is_noted = true;
        }
        if (hand.in_hand.box->has_news())
            write_news(log, hand);
    }
    for (Change change; next_change(change);) {
        keep(change);
        if (!change.change.is_turn())
            recorded_.push_back(change);
    }
    if (!changes_.empty()) {
        std::vector<RecordedButton> buttons;
        std::vector<RecordedKeyPress> presses;
        for (const Change& one : changes_) {
            const Hand& hand = hands_[one.hand];
            const ButtonMeaning* const means = meaning(hand, one.change.button);
            buttons.push_back({.at = one.change.at,
                               .uncertainty = one.change.uncertainty,
                               .trial = one.trial,
                               .box = hand.in_hand.id,
                               .is_operators = hand.in_hand.is_operators,
                               .button = one.change.button,
                               .name = hand.in_hand.box->button_name(one.change.button),
                               .is_down = one.change.is_down,
                               .device_time = one.change.device_time,
                               .meaning = means ? means->words : std::string()});
            if (!one.change.is_down || !one.screen)
                continue;
            presses.push_back({.at = one.change.at,
                               .uncertainty = one.change.uncertainty,
                               .trial = one.trial,
                               .device = buttons.back().box,
                               .name = buttons.back().name,
                               .code = one.change.button,
                               .screen = *one.screen,
                               .meaning = buttons.back().meaning});
        }
        changes_.clear();
        log.buttons(buttons);
        if (!presses.empty())
            log.key_presses(presses);
    }
    if (answering_)
        answering_->write_down(log);
}

std::vector<std::string> ButtonBoxPanel::closing_warnings() const {
    std::vector<std::string> said;
    for (const Hand& hand : hands_) {
        if (hand.losses > 0)
            said.push_back(
                fmt::format("response box \"{}\": it was gone {}: what was pressed then is not known",
                            hand.in_hand.id, counted(hand.losses, "time")));
        if (const std::int64_t forgotten = hand.in_hand.box->forgotten(); forgotten > 0)
            said.push_back(fmt::format("response box \"{}\": {} went lost: too many at once", hand.in_hand.id,
                                       counted(forgotten, "change")));
    }
    if (unrecorded_ > 0)
        said.push_back(fmt::format("response boxes: {} could not be recorded: too many in one presentation",
                                   counted(unrecorded_, "change")));
    return said;
}

} // namespace overt
