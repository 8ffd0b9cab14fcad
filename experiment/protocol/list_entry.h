/// What the entries of a protocol's lists of objects, materials, lights, motions and views have in common.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace overt {

/// What is said of an entry for tables and orders: a word, or a number.
struct EntryColumn {
    std::string name;
    std::string text; ///< of a number: as it is written in tables
    std::optional<double> number;
    bool operator==(const EntryColumn&) const = default;
};

/// Base of the struct of a list's entries.
struct ListEntry {
    std::string id;
    std::string title;
    std::vector<EntryColumn> columns; ///< in the order of the file
};

} // namespace overt
