/// The form of protocol files for editors and other programs.
#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

namespace overt {

/// A JSON Schema (draft 2020-12) of a protocol, made from the table of keys. A file that passes `overt check`
/// fits it; what has to hold between keys, and that sections are there which an included file may have, only
/// `overt check` says.
nlohmann::ordered_json protocol_schema();

/// A text of the table of keys for where no page of docs/ is a click away: "[bake.md](bake.md)" becomes
/// "docs/bake.md".
std::string without_links(std::string_view text);

} // namespace overt
