/// A TOML file as a plain tree in which every key and value knows its place.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "experiment/base/diagnostics.h"

namespace overt {

struct TomlEntry;
struct TomlValue;
struct TomlDate {}; ///< dates and times of day: no key of a protocol takes one
using TomlList = std::vector<TomlValue>;
using TomlTable = std::vector<TomlEntry>;

struct TomlValue {
    Place place; ///< of the value's first character; of a section, its heading
    std::variant<bool, std::int64_t, double, std::string, TomlDate, TomlList, TomlTable> content;

    const TomlTable* table() const { return std::get_if<TomlTable>(&content); }
    const TomlList* list() const { return std::get_if<TomlList>(&content); }

    /// "a text", "a whole number", "a list", …: for messages about what was found.
    std::string_view kind() const;
};

struct TomlEntry {
    std::string key;
    Place key_place;
    TomlValue value;
};

/// What could be read of a file.
struct TomlFile {
    TomlTable root;
    bool is_whole = true; ///< false: lines with syntax errors were passed over, and keys may be lacking
};

/// Reads a text as TOML 1.0. Syntax errors go to `diagnostics` under the name `file`; a line in error is
/// passed over, so that the errors of later lines are found too.
TomlFile parse_toml(std::string_view text, const std::string& file, Diagnostics& diagnostics);

} // namespace overt
