#include "experiment/ports/observer_field.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iterator>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/base/random.h"

namespace overt {

namespace {

struct StandardField {
    std::string_view id, title;
    FieldKind kind;
    std::array<std::string_view, 3> choices;
    double min, max;
};

// The words of sex and handedness are those of BIDS' participants.tsv.
constexpr StandardField standard_fields[] = {
    {"age", "Age in years", FieldKind::number, {}, 0.0, 120.0},
    {"sex", "Sex", FieldKind::choice, {"female", "male", "other"}, 0.0, 0.0},
    {"vision", "Vision", FieldKind::choice, {"normal", "corrected to normal", "impaired"}, 0.0, 0.0},
    {"handedness", "Handedness", FieldKind::choice, {"left", "right", "ambidextrous"}, 0.0, 0.0},
};

/// A number with a decimal point, whatever the machine's language; nothing of it may be left over.
std::optional<double> number_in(std::string_view text) {
    double number = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(number))
        return std::nullopt;
    return number;
}

} // namespace

std::string range_of(const ObserverFieldSettings& field) {
    if (field.kind != FieldKind::number)
        return {};
    if (field.min && field.max)
        return fmt::format("{} … {}", *field.min, *field.max);
    if (field.min)
        return fmt::format("≥ {}", *field.min);
    return field.max ? fmt::format("≤ {}", *field.max) : std::string();
}

std::vector<ObserverFieldSettings> fields_asked(std::span<const ObserverFieldSettings> fields,
                                                std::string_view when) {
    std::vector<ObserverFieldSettings> asked;
    std::ranges::copy_if(fields, std::back_inserter(asked),
                         [&](const ObserverFieldSettings& field) { return field.when == when; });
    return asked;
}

std::vector<std::string> moments_asked(std::span<const ObserverFieldSettings> fields) {
    std::vector<std::string> moments;
    for (const ObserverFieldSettings& field : fields)
        if (std::ranges::find(moments, field.when) == moments.end())
            moments.push_back(field.when);
    return moments;
}

std::vector<RecordedObserverField> filled_in(std::span<const ObserverFieldSettings> fields,
                                             const FieldValues& values, std::optional<SessionTime> at) {
    std::vector<RecordedObserverField> recorded;
    for (std::size_t i = 0; i < fields.size(); ++i) {
        if (!values[i].empty())
            recorded.push_back({fields[i].id, fields[i].title, values[i], fields[i].when, at});
    }
    return recorded;
}

void complete_field(ObserverFieldSettings& field, bool has_kind) {
    const auto standard = std::ranges::find(standard_fields, field.id, &StandardField::id);
    if (standard != std::end(standard_fields) && !has_kind) {
        const bool has_choices = !field.choices.empty();
        field.kind = has_choices ? FieldKind::choice : standard->kind;
        if (standard->kind == FieldKind::choice && !has_choices)
            field.choices.assign(standard->choices.begin(), standard->choices.end());
        if (standard->kind == FieldKind::number) {
            field.min = field.min.value_or(standard->min);
            field.max = field.max.value_or(standard->max);
        }
    }
    if (field.kind == FieldKind::scale) {
        field.choices.clear();
        for (int step = 1; step <= field.steps; ++step)
            field.choices.push_back(std::to_string(step));
    }
    if (field.title.empty())
        field.title = standard != std::end(standard_fields) ? std::string(standard->title) : field.id;
}

std::optional<std::string> fault_of(const ObserverFieldSettings& field, std::string_view value) {
    if (value.empty())
        return field.required ? std::optional(fmt::format("{}: please fill this in: {}.", field.title,
                                                          expected_in(field)))
                              : std::nullopt;
    switch (field.kind) {
    case FieldKind::text:
        return std::nullopt;
    case FieldKind::number: {
        const std::optional<double> number = number_in(value);
        if (number && (!field.min || *number >= *field.min) && (!field.max || *number <= *field.max))
            return std::nullopt;
        break;
    }
    case FieldKind::choice:
    case FieldKind::scale:
        if (std::find(field.choices.begin(), field.choices.end(), value) != field.choices.end())
            return std::nullopt;
        break;
    }
    return fmt::format("{}: \"{}\" is not {}.", field.title, value, expected_in(field));
}

std::string expected_in(const ObserverFieldSettings& field) {
    switch (field.kind) {
    case FieldKind::text:
        return "a text";
    case FieldKind::number: {
        const std::string range = range_of(field);
        return range.empty() ? "a number" : "a number, " + range;
    }
    case FieldKind::scale:
        return fmt::format("a whole number, 1 … {}", field.steps);
    case FieldKind::choice:
        return fmt::format("one of \"{}\"", fmt::join(field.choices, "\", \""));
    }
    return {};
}

std::string trimmed(std::string_view value) {
    constexpr std::string_view white = " \t\r\n";
    const std::size_t first = value.find_first_not_of(white);
    if (first == std::string_view::npos)
        return {};
    return std::string(value.substr(first, value.find_last_not_of(white) - first + 1));
}

std::string simulated_value(const ObserverFieldSettings& field, std::uint64_t seed) {
    RandomStream random(seed, "observer field " + field.id);
    switch (field.kind) {
    case FieldKind::text:
        break;
    case FieldKind::number: {
        // A student's age where that is allowed, else something within the limits.
        constexpr double usual_min = 18.0, usual_max = 35.0;
        double low = std::max(field.min.value_or(usual_min), usual_min);
        double high = std::min(field.max.value_or(usual_max), usual_max);
        if (low > high) {
            low = field.min ? *field.min : *field.max;
            high = field.max.value_or(low);
        }
        const double drawn = std::round(random.uniform(low, high));
        return fmt::format("{}", drawn >= low && drawn <= high ? drawn : low);
    }
    case FieldKind::choice:
    case FieldKind::scale:
        return field.choices[random.below(static_cast<std::uint32_t>(field.choices.size()))];
    }
    return "simulated";
}

} // namespace overt
