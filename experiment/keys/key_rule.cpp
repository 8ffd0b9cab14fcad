#include "experiment/keys/key_rule.h"

#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace overt {

std::string range_text(const KeyRule& rule) {
    const std::string unit = rule.unit.empty() ? "" : fmt::format(" {}", rule.unit);
    if (std::isfinite(rule.low) && std::isfinite(rule.high))
        return fmt::format("{} … {}{}", rule.low, rule.high, unit);
    if (std::isfinite(rule.low))
        return fmt::format("at least {}{}", rule.low, unit);
    if (std::isfinite(rule.high))
        return fmt::format("at most {}{}", rule.high, unit);
    return {};
}

std::string expected_text(const KeyRule& rule, std::string_view noun) {
    if (rule.choices.size() == 1)
        return fmt::format("\"{}\"", rule.choices.front());
    if (!rule.choices.empty())
        return fmt::format("one of \"{}\"", fmt::join(rule.choices, "\", \""));
    if (!rule.unit.empty())
        return fmt::format("{} of {}", noun, rule.unit);
    return std::string(noun);
}

} // namespace overt
