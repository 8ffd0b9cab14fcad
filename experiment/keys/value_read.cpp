#include "experiment/keys/value_read.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace overt {

namespace {

ValueResult check_range(const TomlValue& value, const KeyRule& rule, double number) {
    if (std::isfinite(number) && number >= rule.low && number <= rule.high)
        return std::nullopt;
    if (!std::isfinite(number))
        return ValueFault{value.place, fmt::format("{}: {} is no usable number", rule.name, number)};
    return ValueFault{
        value.place, fmt::format("{}: {} is out of range, which is {}", rule.name, number, range_text(rule))};
}

ValueResult read_whole(const TomlValue& value, const KeyRule& rule, std::int64_t& out) {
    const auto* whole = std::get_if<std::int64_t>(&value.content);
    if (!whole) {
        ValueFault fault = wrong_kind<int>(value, rule);
        if (const auto* number = std::get_if<double>(&value.content);
            number && std::abs(*number) < 1e9 && *number == std::floor(*number))
            fault.hint = fmt::format("write {:.0f}, without the point", *number);
        return fault;
    }
    if (ValueResult fault = check_range(value, rule, static_cast<double>(*whole)))
        return fault;
    out = *whole;
    return std::nullopt;
}

} // namespace

ValueResult read_value(const TomlValue& value, const KeyRule& rule, bool& out) {
    const auto* truth = std::get_if<bool>(&value.content);
    if (!truth)
        return wrong_kind<bool>(value, rule);
    out = *truth;
    return std::nullopt;
}

ValueResult read_value(const TomlValue& value, const KeyRule& rule, int& out) {
    std::int64_t whole = 0;
    if (ValueResult fault = read_whole(value, rule, whole))
        return fault;
    if (whole > std::numeric_limits<int>::max() || whole < std::numeric_limits<int>::min())
        return ValueFault{value.place, fmt::format("{}: {} is too large", rule.name, whole)};
    out = static_cast<int>(whole);
    return std::nullopt;
}

ValueResult read_value(const TomlValue& value, const KeyRule& rule, double& out) {
    double number = 0.0;
    if (const auto* whole = std::get_if<std::int64_t>(&value.content))
        number = static_cast<double>(*whole);
    else if (const auto* real = std::get_if<double>(&value.content))
        number = *real;
    else
        return wrong_kind<double>(value, rule);
    if (ValueResult fault = check_range(value, rule, number))
        return fault;
    out = number;
    return std::nullopt;
}

ValueResult read_value(const TomlValue& value, const KeyRule& rule, Degrees& out) {
    return read_value(value, rule, out.value);
}

ValueResult read_value(const TomlValue& value, const KeyRule& rule, std::string& out) {
    const auto* text = std::get_if<std::string>(&value.content);
    if (!text)
        return wrong_kind<std::string>(value, rule);
    if (!rule.choices.empty() &&
        std::find(rule.choices.begin(), rule.choices.end(), *text) == rule.choices.end()) {
        return ValueFault{value.place, fmt::format("{}: unknown value \"{}\"", rule.name, *text),
                          suggest_name(*text, rule.choices)};
    }
    if (rule.is_identifier) {
        if (ValueResult fault = check_name(*text, value.place, rule.name))
            return fault;
    }
    if (rule.is_required && text->find_first_not_of(" \t\r\n") == std::string::npos)
        return ValueFault{value.place, fmt::format("{}: the text is empty", rule.name)};
    out = *text;
    return std::nullopt;
}

ValueResult read_value(const TomlValue& value, const KeyRule& rule, std::filesystem::path& out) {
    std::string text;
    if (ValueResult fault = read_value(value, rule, text))
        return fault;
    if (text.empty())
        return ValueFault{value.place, fmt::format("{}: the path is empty", rule.name)};
    out = text;
    return std::nullopt;
}

ValueResult read_value(const TomlValue& value, const KeyRule& rule, std::optional<double>& out) {
    return read_value(value, rule, out.emplace());
}

ValueResult read_value(const TomlValue& value, const KeyRule& rule, std::optional<int>& out) {
    return read_value(value, rule, out.emplace());
}

ValueResult read_value(const TomlValue& value, const KeyRule& rule, std::optional<std::uint64_t>& out) {
    std::int64_t whole = 0;
    if (ValueResult fault = read_whole(value, rule, whole))
        return fault;
    out = static_cast<std::uint64_t>(whole);
    return std::nullopt;
}

ValueResult read_value(const TomlValue& value, const KeyRule& rule, std::array<double, 3>& out) {
    return read_numbers<std::array<double, 3>>(value, rule, out.size(), out.data());
}

ValueResult read_value(const TomlValue& value, const KeyRule& rule, std::optional<glm::dvec3>& out) {
    std::array<double, 3> numbers{};
    if (ValueResult fault = read_value(value, rule, numbers))
        return fault;
    out = glm::dvec3(numbers[0], numbers[1], numbers[2]);
    return std::nullopt;
}

ValueResult read_value(const TomlValue& value, const KeyRule& rule, std::vector<double>& out) {
    if (!value.list()) {
        double number = 0.0;
        const bool is_number = std::holds_alternative<double>(value.content) ||
                               std::holds_alternative<std::int64_t>(value.content);
        if (!is_number)
            return wrong_kind<std::vector<double>>(value, rule);
        if (ValueResult fault = read_value(value, rule, number))
            return fault;
        out = {number};
        return std::nullopt;
    }
    out.resize(value.list()->size());
    return read_numbers<std::vector<double>>(value, rule, out.size(), out.data());
}

ValueResult read_value(const TomlValue& value, const KeyRule& rule, std::vector<std::string>& out) {
    out.clear(); // of what it is when the key is left out
    if (!value.list()) {
        if (!std::holds_alternative<std::string>(value.content))
            return wrong_kind<std::vector<std::string>>(value, rule);
        return read_value(value, rule, out.emplace_back());
    }
    for (const TomlValue& item : *value.list()) {
        if (ValueResult fault = read_value(item, rule, out.emplace_back()))
            return fault;
    }
    if (out.empty())
        return ValueFault{value.place, fmt::format("{}: the list is empty", rule.name),
                          "leave the key out to take all"};
    return std::nullopt;
}

} // namespace overt
