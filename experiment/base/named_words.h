/// Values of keys that are tables of names that the reader does not know: `{ object = 2, gloss = 3 }`.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace overt {

/// A whole number for each name, in the order of the file.
struct NamedNumber {
    std::string name;
    int number = 0;
};
using NamedNumbers = std::vector<NamedNumber>;

/// A word or a number for each name, in the order of the file.
struct NamedWord {
    std::string name;
    std::string text = {};             ///< of a number: as it is written in tables
    std::optional<double> number = {}; ///< nothing: a word
    bool operator==(const NamedWord&) const = default;
};
using NamedWords = std::vector<NamedWord>;

/// Keys that a series sets, one value for each entry that it is written out into.
struct Series {
    std::vector<std::string> keys = {};
};

} // namespace overt
