#include "experiment/checks/observer_keys.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace overt {

namespace {

/// Of a keyboard, besides letters and digits.
constexpr auto named_keys = std::to_array<std::string_view>(
    {"space", "enter",   "tab",       "backspace", "left",   "right", "up",  "down", "home",
     "end",   "page up", "page down", "insert",    "delete", "f1",    "f2",  "f3",   "f4",
     "f5",    "f6",      "f7",        "f8",        "f9",     "f10",   "f11", "f12",  "pause"});

} // namespace

KeyFault fault_of_observer_key(const Protocol& protocol, std::string_view key) {
    const OperatorSettings& operators = protocol.operators;
    const std::pair<std::string_view, const std::string*> taken[] = {
        {"pause", &operators.pause},   {"recalibrate", &operators.recalibrate},
        {"repeat", &operators.repeat}, {"reject", &operators.reject},
        {"skip", &operators.skip},     {"abort", &operators.abort}};
    for (const auto& [name, of] : taken)
        if (*of == key)
            return {fmt::format("the key \"{}\" is the operator's: \"{}\" of [operator]", key, name),
                    "take another one"};
    const bool is_letter =
        key.size() == 1 && ((key[0] >= 'a' && key[0] <= 'z') || (key[0] >= '0' && key[0] <= '9'));
    if (!is_letter && protocol.button_boxes.empty() && std::ranges::find(named_keys, key) == named_keys.end())
        return {fmt::format("there is no key \"{}\"", key),
                fmt::format("letters, digits, {}", fmt::join(named_keys, ", "))};
    return {};
}

} // namespace overt
