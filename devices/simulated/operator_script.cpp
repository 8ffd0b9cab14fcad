#include "devices/simulated/operator_script.h"

#include <algorithm>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/base/text_number.h"
#include "experiment/base/utf8_text.h"
#include "experiment/ports/recorded_key_press.h"
#include "experiment/ports/response_panel.h"
#include "experiment/ports/session_phase.h"

namespace overt {

namespace {

using Key = ResponsePress::Key;

constexpr Key keys[] = {Key::pause,  Key::recalibrate, Key::drift_check, Key::repeat,
                        Key::reject, Key::skip,        Key::abort};

/// As at a keyboard: what writes a character, space and enter.
bool goes_on(std::string_view name) {
    const auto letters = std::ranges::count_if(
        name, [](char byte) { return (static_cast<unsigned char>(byte) & 0xc0) != 0x80; });
    return letters == 1 || name == "space" || name == "enter";
}

[[noreturn]] void refuse(std::string_view text, std::string_view why) {
    std::string phases;
    for (int i = 0; i < session_phase_count; ++i)
        phases += fmt::format("{}{}", i == 0 ? "" : ", ", name_of(static_cast<SessionPhase>(i)));
    throw InputError(fmt::format(
        "--simulate-operator {}: {}; write PHASE[@TRIAL]+SECONDS=KEY[,ANSWER], as "
        "\"stimulus@3+0.5=skip,2\". Phases: {}. Keys: pause, recalibrate, drift check, repeat, "
        "reject, skip, abort; or press and the name of a key of the observer's, as \"press 7\"; or, "
        "where something is answered, type and words, click RIGHT DOWN, drag RIGHT DOWN RIGHT "
        "DOWN, or wheel STEPS. Answers: yes, no, or the digit of a reason",
        text, why, phases));
}

using Kind = ObserverInput::Kind;
constexpr SessionDuration usual_hold = std::chrono::milliseconds(80);
constexpr SessionDuration between_letters = std::chrono::milliseconds(50);
constexpr SessionDuration drag_lasts = std::chrono::milliseconds(200);
constexpr int drag_steps = 10;

void add(ScriptedOperatorKey& scripted, SessionDuration after, ObserverInput input) {
    const bool is_mouse = input.kind >= Kind::pointer_moved && input.kind <= Kind::wheel;
    input.device = ShortName(is_mouse ? mouse_device : simulated_observer_device);
    scripted.inputs.push_back({after, input});
}

/// Of UTF-8; of anything else, nothing.
std::u32string characters_of(std::string_view text) {
    std::u32string characters;
    if (!is_utf8(text))
        return characters;
    for (const char byte : text) {
        const auto bits = static_cast<unsigned char>(byte);
        if ((bits & 0xc0) == 0x80)
            characters.back() = (characters.back() << 6) | (bits & 0x3f);
        else // the first byte has as many bits less as there are bytes
            characters += bits < 0x80   ? bits
                          : bits < 0xe0 ? bits & 0x1f
                          : bits < 0xf0 ? bits & 0x0f
                                        : bits & 0x07;
    }
    return characters;
}

/// All of `count` numbers, or nothing.
std::vector<double> numbers_in(std::string_view words, std::size_t count) {
    std::vector<double> numbers;
    while (!words.empty()) {
        const std::size_t end = std::min(words.find(' '), words.size());
        if (const auto number = number_in<double>(words.substr(0, end)))
            numbers.push_back(*number);
        else if (end > 0)
            return {};
        words.remove_prefix(std::min(end + 1, words.size()));
    }
    return numbers.size() == count ? numbers : std::vector<double>();
}

/// A key goes down and up; what writes, writes.
void add_press(ScriptedOperatorKey& scripted, std::string_view name, SessionDuration held) {
    const ShortName key(name);
    add(scripted, {}, {.kind = Kind::key_down, .key = key});
    const std::string written = name == "space" ? " " : std::string(name);
    if (const std::u32string characters = characters_of(written); characters.size() == 1)
        add(scripted, {}, {.kind = Kind::text, .character = characters[0]});
    add(scripted, held, {.kind = Kind::key_up, .key = key});
}

void add_pointer(ScriptedOperatorKey& scripted, const std::vector<double>& places) {
    const auto at = [&](Kind kind, double right, double down) {
        return ObserverInput{
            .kind = kind, .right_px = right, .down_px = down, .button = kind == Kind::pointer_moved ? 0 : 1};
    };
    add(scripted, {}, at(Kind::pointer_moved, places[0], places[1]));
    add(scripted, {}, at(Kind::pointer_down, places[0], places[1]));
    if (places.size() == 2) {
        add(scripted, usual_hold, at(Kind::pointer_up, places[0], places[1]));
        return;
    }
    for (int step = 1; step <= drag_steps; ++step) {
        const double share = static_cast<double>(step) / drag_steps;
        add(scripted, step * drag_lasts / drag_steps,
            at(Kind::pointer_moved, places[0] + share * (places[2] - places[0]),
               places[1] + share * (places[3] - places[1])));
    }
    add(scripted, drag_lasts, at(Kind::pointer_up, places[2], places[3]));
}

/// What the observer does, if the words begin with one of its verbs.
bool read_observers(ScriptedOperatorKey& scripted, std::string_view words, std::string_view text) {
    const std::size_t space = words.find(' ');
    const std::string_view verb = words.substr(0, space);
    const std::string_view what = space == std::string_view::npos ? "" : words.substr(space + 1);
    const auto with_numbers = [&](std::size_t count) {
        std::vector<double> numbers = numbers_in(what, count);
        if (numbers.empty())
            refuse(text, fmt::format("{} is followed by {} numbers", verb, count));
        return numbers;
    };
    if (verb == "press") {
        std::string_view name = what;
        SessionDuration held = usual_hold;
        if (const std::size_t at = name.rfind(" for "); at != std::string_view::npos)
            if (const auto seconds = number_in<double>(name.substr(at + 5)); seconds && *seconds >= 0.0) {
                held = from_seconds(*seconds);
                name = name.substr(0, at);
            }
        if (name.empty())
            refuse(text, "the key has no name");
        scripted.pressed = name;
        scripted.key = goes_on(name) ? Key::next : Key::up;
        add_press(scripted, name, held);
    } else if (verb == "type") {
        SessionDuration after{};
        for (const char32_t character : characters_of(what)) {
            add(scripted, after, {.kind = Kind::text, .character = character});
            after += between_letters;
        }
        if (scripted.inputs.empty())
            refuse(text, "nothing is typed");
    } else if (verb == "click") {
        add_pointer(scripted, with_numbers(2));
    } else if (verb == "drag") {
        add_pointer(scripted, with_numbers(4));
    } else if (verb == "wheel") {
        add(scripted, {}, {.kind = Kind::wheel, .steps = with_numbers(1)[0]});
    } else {
        return false;
    }
    return true;
}

} // namespace

ScriptedOperatorKey read_operator_key(std::string_view text, int reasons) {
    ScriptedOperatorKey scripted;
    scripted.text = text;
    const std::size_t equals = text.find('='), plus = text.substr(0, equals).rfind('+');
    if (equals == std::string_view::npos || plus == std::string_view::npos)
        refuse(text, "there is no + or no =");
    std::string_view phase = text.substr(0, plus);
    if (const std::size_t at = phase.find('@'); at != std::string_view::npos) {
        const auto trial = number_in<int>(phase.substr(at + 1));
        if (!trial || *trial < 1)
            refuse(text, "trials count from 1");
        scripted.trial = *trial - 1;
        phase = phase.substr(0, at);
    }
    bool is_known = false;
    for (int i = 0; i < session_phase_count; ++i) {
        if (name_of(static_cast<SessionPhase>(i)) == phase) {
            scripted.phase = static_cast<SessionPhase>(i);
            is_known = true;
        }
    }
    if (!is_known)
        refuse(text, fmt::format("there is no phase \"{}\"", phase));
    const auto seconds = number_in<double>(text.substr(plus + 1, equals - plus - 1));
    if (!seconds || !(*seconds >= 0.0 && *seconds < 86400.0))
        refuse(text, "the seconds are no number of seconds");
    scripted.after_s = *seconds;
    if (read_observers(scripted, text.substr(equals + 1), text))
        return scripted;
    const std::string_view rest = text.substr(equals + 1), key = rest.substr(0, rest.find(','));
    const auto known = std::ranges::find(keys, key, [](Key one) { return name_of(one); });
    if (known == std::end(keys))
        refuse(text, fmt::format("there is no key \"{}\"", key));
    scripted.key = *known;
    if (rest.size() > key.size()) {
        const std::string_view answer = rest.substr(key.size() + 1);
        const bool is_digit = answer.size() == 1 && answer[0] >= '1' && answer[0] <= '9';
        if (answer != "yes" && answer != "no" && !is_digit)
            refuse(text, fmt::format("\"{}\" is no answer", answer));
        if (is_digit && scripted.key != Key::skip)
            refuse(text, "only skipping has reasons");
        if (is_digit && answer[0] - '0' > reasons)
            refuse(text,
                   fmt::format("there is no reason {}: [operator] skip_reasons has {}", answer, reasons));
        scripted.answer = static_cast<char32_t>(answer[0]);
    }
    return scripted;
}

} // namespace overt
