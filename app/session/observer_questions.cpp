#include "app/session/observer_questions.h"

#include <algorithm>
#include <istream>
#include <ostream>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/base/diagnostics.h"
#include "experiment/base/error.h"

namespace overt {

namespace {

std::size_t field_called(std::span<const ObserverFieldSettings> fields, const std::string& id) {
    std::vector<std::string_view> ids;
    for (const ObserverFieldSettings& field : fields)
        ids.push_back(field.id);
    const auto found = std::find(ids.begin(), ids.end(), id);
    if (found != ids.end())
        return static_cast<std::size_t>(found - ids.begin());
    throw InputError(ids.empty()
                         ? fmt::format("--observer-field {}: the protocol has no [[observer_field]]", id)
                         : fmt::format("--observer-field {}: there is no such field; there are: {}", id,
                                       fmt::join(ids, ", ")));
}

} // namespace

FieldValues values_given(std::span<const ObserverFieldSettings> fields, std::span<const std::string> given) {
    FieldValues values(fields.size());
    for (const std::string& text : given) {
        const std::size_t equals = text.find('=');
        if (equals == std::string::npos)
            throw InputError(fmt::format("--observer-field {}: write ID=VALUE, as age=31", text));
        const std::size_t index = field_called(fields, trimmed(text.substr(0, equals)));
        const std::string value = trimmed(text.substr(equals + 1));
        if (!values[index].empty())
            throw InputError(fmt::format("--observer-field {}: this field is given twice", text));
        if (const auto fault = fault_of(fields[index], value))
            throw InputError(fmt::format("--observer-field {}: {}", text, *fault));
        values[index] = value;
    }
    return values;
}

void ask_for_values(std::span<const ObserverFieldSettings> fields, FieldValues& values, std::istream& from,
                    std::ostream& to) {
    for (std::size_t i = 0; i < fields.size(); ++i) {
        const ObserverFieldSettings& field = fields[i];
        if (!values[i].empty() || field.when != form_at_begin)
            continue;
        if (!field.note.empty())
            to << field.note << "\n";
        for (bool is_answered = false; !is_answered;) {
            to << fmt::format("{} ({}{}): ", field.title, expected_in(field),
                              field.required ? "" : "; may be left empty")
               << std::flush;
            std::string line;
            if (!std::getline(from, line))
                throw InputError(
                    fmt::format("the form was left at \"{}\": no session was begun", field.title));
            const std::string value = trimmed(line);
            const auto fault = fault_of(field, value);
            is_answered = !fault;
            if (fault)
                to << *fault << "\n";
            else
                values[i] = value;
        }
    }
}

void simulate_values(std::span<const ObserverFieldSettings> fields, FieldValues& values, std::uint64_t seed) {
    for (std::size_t i = 0; i < fields.size(); ++i) {
        if (values[i].empty())
            values[i] = simulated_value(fields[i], seed);
    }
}

void require_values(std::span<const ObserverFieldSettings> fields, const FieldValues& values,
                    bool is_opened) {
    std::vector<std::string> missing;
    for (std::size_t i = 0; i < fields.size(); ++i) {
        if (fields[i].required && values[i].empty() && !(is_opened && fields[i].when == form_at_begin))
            missing.push_back(fmt::format("\n  --observer-field {}=…   {}: {}", fields[i].id, fields[i].title,
                                          expected_in(fields[i])));
    }
    if (!missing.empty())
        throw InputError(
            fmt::format("the protocol asks for these of the observer, and they cannot be asked for here:{}",
                        fmt::join(missing, "")));
}

} // namespace overt
