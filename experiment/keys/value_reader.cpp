#include "experiment/keys/value_reader.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "experiment/keys/value_type.h"

namespace overt {

namespace {

template <class Value> ValueFault wrong_kind(const TomlValue& value, const KeyRule& rule) {
    const std::string_view noun = value_type(TypeTag<Value>()).noun;
    return {value.place,
            fmt::format("{}: expected {}, found {}", rule.name, expected_text(rule, noun), value.kind())};
}

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

/// The numbers of a list of exactly `count`, in a Value. The range of the rule holds for each.
template <class Value>
ValueResult read_numbers(const TomlValue& value, const KeyRule& rule, std::size_t count, double* out) {
    const TomlList* list = value.list();
    if (!list)
        return wrong_kind<Value>(value, rule);
    if (list->size() != count) {
        return ValueFault{value.place,
                          fmt::format("{}: expected {} numbers, found {}", rule.name, count, list->size())};
    }
    for (std::size_t i = 0; i < count; ++i) {
        if (ValueResult fault = read_value((*list)[i], rule, out[i]))
            return fault;
    }
    return std::nullopt;
}

bool is_identifier_character(char character) {
    return (character >= 'a' && character <= 'z') || (character >= 'A' && character <= 'Z') ||
           (character >= '0' && character <= '9') || character == '-' || character == '_';
}

ValueResult check_identifier(const TomlValue& value, const KeyRule& rule, const std::string& text) {
    constexpr std::size_t longest = 40;
    if (!text.empty() && text.size() <= longest &&
        std::all_of(text.begin(), text.end(), is_identifier_character))
        return std::nullopt;
    return ValueFault{value.place, fmt::format("{}: \"{}\" cannot be used in file names", rule.name, text),
                      fmt::format("take 1 to {} of the letters a to z and A to Z, digits, - and _", longest)};
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
        if (ValueResult fault = check_identifier(value, rule, *text))
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

ValueResult read_value(const TomlValue& value, const KeyRule& rule, std::optional<glm::dvec3>& out) {
    std::array<double, 3> numbers{};
    if (ValueResult fault = read_value(value, rule, numbers))
        return fault;
    out = glm::dvec3(numbers[0], numbers[1], numbers[2]);
    return std::nullopt;
}

ValueResult read_value(const TomlValue& value, const KeyRule& rule, std::array<double, 3>& out) {
    return read_numbers<std::array<double, 3>>(value, rule, out.size(), out.data());
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

ValueResult read_value(const TomlValue& value, const KeyRule& rule, std::vector<std::array<double, 4>>& out) {
    using Spheres = std::vector<std::array<double, 4>>;
    if (!value.list())
        return wrong_kind<Spheres>(value, rule);
    for (const TomlValue& item : *value.list()) {
        std::array<double, 4> sphere{};
        if (ValueResult fault = read_numbers<Spheres>(item, rule, sphere.size(), sphere.data()))
            return fault;
        if (!(sphere[3] > 0.0))
            return ValueFault{
                item.place, fmt::format("{}: a sphere's radius of {} is not above 0", rule.name, sphere[3])};
        out.push_back(sphere);
    }
    return std::nullopt;
}

ValueResult read_value(const TomlValue& value, const KeyRule& rule, std::vector<std::array<double, 6>>& out) {
    using Planes = std::vector<std::array<double, 6>>;
    if (!value.list())
        return wrong_kind<Planes>(value, rule);
    for (const TomlValue& item : *value.list()) {
        const TomlList* pair = item.list();
        if (!pair || pair->size() != 2)
            return ValueFault{
                item.place,
                fmt::format("{}: expected a point and a direction, [[x, y, z], [nx, ny, nz]]", rule.name)};
        std::array<double, 6> plane{};
        for (std::size_t half = 0; half < 2; ++half) {
            if (ValueResult fault = read_numbers<Planes>((*pair)[half], rule, 3, plane.data() + 3 * half))
                return fault;
        }
        if (plane[3] == 0.0 && plane[4] == 0.0 && plane[5] == 0.0)
            return ValueFault{(*pair)[1].place,
                              fmt::format("{}: a direction of length 0 points nowhere", rule.name)};
        out.push_back(plane);
    }
    return std::nullopt;
}

ValueResult read_choice(const TomlValue& value, const KeyRule& rule, std::size_t& index) {
    std::string name;
    if (ValueResult fault = read_value(value, rule, name))
        return fault;
    index = static_cast<std::size_t>(std::find(rule.choices.begin(), rule.choices.end(), name) -
                                     rule.choices.begin());
    return std::nullopt;
}

} // namespace overt
