/// Columns that several tables share.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "experiment/factors.h"
#include "experiment/record/session_header.h"
#include "experiment/record/tables/row_layout.h"

namespace overt {

/// An item of a list of the header that is known to have it.
const auto& item(const auto& list, int index) { return list[static_cast<std::size_t>(index)]; }

/// An item of a list of the header, or null if it has no such.
template <class List> const auto* item_of(const List& list, int index) {
    return index >= 0 && static_cast<std::size_t>(index) < list.size()
               ? &list[static_cast<std::size_t>(index)]
               : nullptr;
}

/// A column of what a stimulus is: its entry of a list, or what is said of that.
struct StimulusColumn {
    TableColumn what;
    std::size_t list = 0;              ///< row of stimulus_lists
    std::vector<FactorLevel> of_entry; ///< by index of the list's entry

    const FactorLevel& level_of(const Stimulus& stimulus) const {
        // Views count on from those of the list (SessionHeader::in_slot).
        return of_entry.at(static_cast<std::size_t>(stimulus.*stimulus_lists[list].index) % of_entry.size());
    }
};

/// Of lists with several entries, always of object and material; then of the columns of all lists.
std::vector<StimulusColumn> stimulus_columns_of(const SessionHeader& header);

/// A level as a cell: a number, a word, or missing.
void put_level(TableCells& to, const FactorLevel& level);
/// The same for TableCells::ready().
std::string level_cell(const FactorLevel& level, TableFormat format);

struct SharedColumns {
    /// Levels name the session's own tasks and entries of lists.
    explicit SharedColumns(const SessionHeader& header);

    /// The columns of stimuli, for rows of which `stimulus_of` tells the stimulus.
    template <class Row> std::vector<typename RowLayout<Row>::Column> of_stimulus(auto stimulus_of) const {
        std::vector<typename RowLayout<Row>::Column> columns;
        for (const StimulusColumn& column : stimulus)
            columns.push_back({column.what, [column, stimulus_of](TableCells& to, const Row& row) {
                                   put_level(to, column.level_of(stimulus_of(row)));
                               }});
        return columns;
    }

    TableColumn trial, task, slot, angle;
    std::vector<StimulusColumn> stimulus;
    bool has_slots; ///< more than one: tables say in which something was
};

inline TableColumn eye_column() {
    return {"eye", "Which eye", "", {{"left", "left eye"}, {"right", "right eye"}}};
}
inline std::string_view word_of_eye(Eye eye) { return eye == Eye::left ? "left" : "right"; }

/// Of a clock's time, as the tracker's and boxes' own have it.
constexpr auto microseconds_of = [](auto time) -> std::int64_t { return time.time_since_epoch().count(); };

/// A time by the session's clock.
TableColumn session_seconds(std::string name, const std::string& meaning);

} // namespace overt
