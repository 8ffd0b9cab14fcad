#include "devices/simulated/operator_script.h"

#include <algorithm>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/base/text_number.h"
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
    throw InputError(
        fmt::format("--simulate-operator {}: {}; write PHASE[@TRIAL]+SECONDS=KEY[,ANSWER], as "
                    "\"stimulus@3+0.5=skip,2\". Phases: {}. Keys: pause, recalibrate, drift check, repeat, "
                    "reject, skip, abort; or press and the name of a key of the observer's, as \"press 7\". "
                    "Answers: yes, no, or the digit of a reason",
                    text, why, phases));
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
    constexpr std::string_view press = "press ";
    if (const std::string_view name = text.substr(equals + 1); name.starts_with(press)) {
        scripted.pressed = name.substr(press.size());
        if (scripted.pressed.empty())
            refuse(text, "the key has no name");
        scripted.key = goes_on(scripted.pressed) ? Key::next : Key::up;
        return scripted;
    }
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
