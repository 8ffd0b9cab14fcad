/// What the layouts of a study's tables share.
#pragma once

#include <algorithm>
#include <initializer_list>
#include <string>
#include <vector>

#include "experiment/study/study_columns.h"

namespace overt {

inline constexpr int share_decimals = 6, second_decimals = 6, place_decimals = 6, density_decimals = 9;

/// An item by its index.
const auto& of(const auto& list, int index) { return list[static_cast<std::size_t>(index)]; }

/// Columns of `--by` that the own ones do not have.
inline std::vector<std::string> others_of(const std::vector<std::string>& by,
                                          std::initializer_list<const char*> own) {
    std::vector<std::string> others;
    for (const std::string& column : by) {
        if (std::find(own.begin(), own.end(), column) == own.end())
            others.push_back(column);
    }
    return others;
}

/// The keys of a group, and the sculpture that a row of a group is of.
template <class Row> StudyColumns<Row> group_columns(const StudyResults& results) {
    auto columns = key_columns<Row>(results.by, [&results](const Row& row) -> const std::vector<StudyKey>& {
        return of(results.groups, row.group).keys;
    });
    add_columns<Row>(columns, text_column<Row>("on_sculpture", "The sculpture on whose surface this is",
                                               [&results](const Row& row) {
                                                   return of(results.sculptures, row.sculpture).id;
                                               }));
    return columns;
}

} // namespace overt
