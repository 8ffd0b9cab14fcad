/// The observer's form outside of the window: from the command line, in the terminal, or from a seed.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "experiment/ports/observer_field.h"

namespace overt {

/// The values of `ID=VALUE` texts, in the order of the fields, empty where nothing is given. Throws
/// InputError for a field that the protocol does not have, one that is given twice, or a value that may not
/// stand.
FieldValues values_given(std::span<const ObserverFieldSettings> fields, std::span<const std::string> given);

/// Asks for each field of the beginning that has no value yet, again until the answer may stand; an empty
/// line leaves out what is not required. Throws InputError when the input ends.
void ask_for_values(std::span<const ObserverFieldSettings> fields, FieldValues& values, std::istream& from,
                    std::ostream& to);

/// What a simulated observer of this seed says, where there is no value yet.
void simulate_values(std::span<const ObserverFieldSettings> fields, FieldValues& values, std::uint64_t seed);

/// Throws InputError naming the required fields without a value and the option that gives them; also those of
/// later, for where nobody types in a window, nobody can be asked then. `is_opened`: without those of the
/// beginning.
void require_values(std::span<const ObserverFieldSettings> fields, const FieldValues& values,
                    bool is_opened = false);

} // namespace overt
