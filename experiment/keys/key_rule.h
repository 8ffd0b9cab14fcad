/// What may stand behind a key of a TOML file, and how that is said.
#pragma once

#include <limits>
#include <span>
#include <string>
#include <string_view>

namespace overt {

/// What may be written for a key besides what its type says. A row of a table makes it by the functions
/// below.
struct KeyLimits {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity(); ///< both ends are allowed
    std::string_view unit = {}; ///< "mm", "Hz", …; empty for texts and plain numbers
    /// The texts allowed, if not every text is. Of an enumeration: its names, in the order of its values;
    /// left out where the enumeration has names of its own (enum_names.h).
    std::span<const std::string_view> choices = {};
    bool is_required = false;
    bool is_identifier = false;        ///< a text of letters, digits, - and _, fit for a file name
    std::string_view if_left_out = {}; ///< what a key without a fixed default means when it is left out

    constexpr KeyLimits required() const {
        KeyLimits limits = *this;
        limits.is_required = true;
        return limits;
    }
    constexpr KeyLimits left_out(std::string_view meaning) const {
        KeyLimits limits = *this;
        limits.if_left_out = meaning;
        return limits;
    }
};

constexpr KeyLimits range(double low, double high, std::string_view unit = {}) { return {low, high, unit}; }
constexpr KeyLimits at_least(double low) { return {.low = low}; }
constexpr KeyLimits one_of(std::span<const std::string_view> choices) { return {.choices = choices}; }
constexpr KeyLimits left_out(std::string_view meaning) { return {.if_left_out = meaning}; }
constexpr KeyLimits required() { return {.is_required = true}; }
constexpr KeyLimits identifier() { return {.is_identifier = true}; }

/// What is known of a key without knowing whose it is.
struct KeyRule : KeyLimits {
    std::string_view name;
    std::string_view explanation;
};

/// The range in words, as "1 … 1000 Hz"; empty if there is none.
std::string range_text(const KeyRule& rule);

/// "a number of Hz", "one of "cycle", "ping-pong"": a noun with the rule's unit and choices.
std::string expected_text(const KeyRule& rule, std::string_view noun);

} // namespace overt
