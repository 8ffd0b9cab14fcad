/// JSON to text and back. The reader and the printer of the library are compiled here alone: each file that
/// uses them itself takes seconds longer.
#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

namespace overt {

/// Indented, always valid UTF-8, with a newline at its end.
std::string json_text(const nlohmann::ordered_json& json);

/// A text as JSON has it, in its quotes; always valid UTF-8.
std::string json_quoted(std::string_view text);

/// What the text says; is_discarded() if it is no JSON.
nlohmann::ordered_json parse_json(std::string_view text);

} // namespace overt
