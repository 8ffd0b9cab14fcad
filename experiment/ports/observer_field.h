/// What is asked of an observer before a session: age, handedness, and whatever else a protocol wants to
/// know.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "experiment/base/enum_names.h"

namespace overt {

enum class FieldKind : std::uint8_t { text, number, choice };
template <> inline constexpr auto names_of<FieldKind> = enum_names<FieldKind>("text", "number", "choice");

/// [[observer_field]]
struct ObserverFieldSettings {
    std::string id;    ///< age, sex, vision and handedness have all else by default
    std::string title; ///< what is asked
    FieldKind kind = FieldKind::text;
    std::vector<std::string> choices;
    std::optional<double> min, max; ///< of a number
    bool required = true;
    std::string note; ///< shown while the field is filled in
};

/// One field as it was filled in; of an optional one that was left empty there is none.
struct RecordedObserverField {
    std::string id, title, value;
    bool operator==(const RecordedObserverField&) const = default;
};

/// What stands in the form, in the order of its fields; empty where nothing does.
using FieldValues = std::vector<std::string>;

/// The fields that have a value.
std::vector<RecordedObserverField> filled_in(std::span<const ObserverFieldSettings> fields,
                                             const FieldValues& values);

/// Gives a standard field what its entry leaves out; others take their id for a title. `has_kind`: the entry
/// says what kind it is.
void complete_field(ObserverFieldSettings& field, bool has_kind);

/// What is wrong with this value, in a sentence for whoever fills in the form; nothing if it may stand. An
/// empty value may stand where the field is not required.
std::optional<std::string> fault_of(const ObserverFieldSettings& field, std::string_view value);

/// The range of a number in signs alone: "0 … 120", "≥ 0"; empty if there is none.
std::string range_of(const ObserverFieldSettings& field);

/// What may stand there, in words: `a number, 0 … 120`, `one of "left", "right"`.
std::string expected_in(const ObserverFieldSettings& field);

/// Without white space at its ends.
std::string trimmed(std::string_view value);

/// What a simulated observer says: drawn from the seed, and never at fault.
std::string simulated_value(const ObserverFieldSettings& field, std::uint64_t seed);

} // namespace overt
