/// What a text has to be before it is read as TOML, and what would mend it where it cannot be.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "experiment/base/diagnostics.h"

namespace overt {

/// Why a text is not read at all: the one error that is said of it.
struct UnreadableText {
    Place place;
    std::string message;
    std::string hint;
};

/// An encoding other than UTF-8, by its mark or its zeros; or a key of more parts (a.b.c…) than any section
/// has, for the reader goes into each of them and its stack has an end.
std::optional<UnreadableText> why_unreadable(std::string_view text);

/// In words, what would mend the line at a place where a TOML reader fails; empty if nobody knows. Told from
/// what is written there, whatever the reader says of it; the lines above are without error.
std::string toml_remedy(std::string_view text, Place place);

} // namespace overt
