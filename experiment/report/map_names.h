/// What files of maps are called.
#pragma once

#include <cctype>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "experiment/study/results/study_results.h"

namespace overt {

/// "task free, material rough"; "all" without keys.
inline std::string words_of_keys(const std::vector<StudyKey>& keys) {
    std::string words;
    for (const StudyKey& key : keys)
        words += fmt::format("{}{} {}", words.empty() ? "" : ", ", key.column, key.value);
    return words.empty() ? "all" : words;
}

/// How large an object with a known scale was shown, for files that are in its own millimetres.
inline std::string shown_size_words(const StudyObject& object) {
    const double size = object.shown_size.value_or(1.0);
    return object.unit == "mm"
               ? fmt::format("{:.6g} times as large as the object, on the display", size)
               : fmt::format("as large as the object, on the display: the unit of the mesh is not known, and "
                             "the object is taken to be as large as its picture, {:.9g} mm for a unit",
                             object.mm_per_unit.value_or(1.0));
}

/// Letters and digits, each other sign as an underscore; names that are alike then are numbered.
class FileNames {
  public:
    std::string of(std::string_view text) {
        std::string wanted;
        for (const char c : text)
            wanted += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
        std::string name = wanted;
        for (int n = 2; !taken_.insert(name).second; ++n)
            name = fmt::format("{}_{}", wanted, n);
        return name;
    }

  private:
    std::set<std::string> taken_;
};

} // namespace overt
