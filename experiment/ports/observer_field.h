/// What is asked of an observer: before a session age, handedness, and whatever else a protocol wants to
/// know; questionnaires after a block and at the end.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "experiment/base/enum_names.h"
#include "experiment/session_time.h"

namespace overt {

enum class FieldKind : std::uint8_t {
    text,
    number,
    choice,
    scale ///< one of the numbers from 1 to `steps`, between two ends
};
template <>
inline constexpr auto names_of<FieldKind> = enum_names<FieldKind>("text", "number", "choice", "scale");

/// When a part of the form is filled in, as `when` has it; "block:ID" is once the trials of that block are
/// done.
inline constexpr std::string_view form_at_begin = "begin", form_at_end = "end", form_after_block = "block:";

/// [[observer_field]]
struct ObserverFieldSettings {
    std::string id;    ///< age, sex, vision and handedness have all else by default
    std::string title; ///< what is asked
    FieldKind kind = FieldKind::text;
    std::vector<std::string> choices;
    std::optional<double> min, max; ///< of a number
    bool required = true;
    std::string note;                   ///< shown while the field is filled in
    int steps = 7;                      ///< of a scale
    std::vector<std::string> ends = {}; ///< of a scale: words at its first and its last step, or none
    std::string when = std::string(form_at_begin);

    /// What stands there is one of `choices`, as complete_field() has them.
    bool has_choices() const { return kind == FieldKind::choice || kind == FieldKind::scale; }
};

/// Those that are asked then, in their order.
std::vector<ObserverFieldSettings> fields_asked(std::span<const ObserverFieldSettings> fields,
                                                std::string_view when);
/// Each `when` that a field has, once, in the order in which fields have them.
std::vector<std::string> moments_asked(std::span<const ObserverFieldSettings> fields);

/// One field as it was filled in; of an optional one that was left empty there is none.
struct RecordedObserverField {
    std::string id, title, value;
    std::string asked = std::string(form_at_begin); ///< see ObserverFieldSettings::when
    std::optional<SessionTime> at = {}; ///< when it was filled in; sessions of earlier programs do not say
    bool operator==(const RecordedObserverField&) const = default;
};

/// What stands in the form, in the order of its fields; empty where nothing does.
using FieldValues = std::vector<std::string>;

/// The fields that have a value, all of one moment.
std::vector<RecordedObserverField> filled_in(std::span<const ObserverFieldSettings> fields,
                                             const FieldValues& values, std::optional<SessionTime> at = {});

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
