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

/// In words, what would mend a line that `message` of the TOML reader is about; empty if nobody knows.
/// `column` counts characters from 1.
std::string toml_remedy(std::string_view message, std::string_view line, int column);

} // namespace overt
