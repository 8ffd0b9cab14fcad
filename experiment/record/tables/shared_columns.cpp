#include "experiment/record/tables/shared_columns.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "experiment/base/plain_text.h"

namespace overt {

std::vector<StimulusColumn> stimulus_columns_of(const SessionHeader& header) {
    const Factors factors = factors_of(header);
    std::vector<StimulusColumn> columns;
    for (const Factor& factor : factors.all()) {
        const bool is_list = factor.source == Factor::Source::list,
                   is_column = factor.source == Factor::Source::column;
        const StimulusList& list = stimulus_lists[factor.list];
        if (!is_column && !(is_list && (list.is_always_named || factor.levels.size() > 1)))
            continue;
        StimulusColumn column{{factor.name, is_list
                                                ? std::string(list.shown)
                                                : fmt::format("What the protocol says of the {}", list.name)},
                              factor.list,
                              {}};
        if (is_list)
            for (const ListEntry& entry : entries_of(header, factor.list))
                column.what.levels.emplace_back(entry.id, plain_line_of(entry.title));
        for (const int level : factor.level_of_entry)
            column.of_entry.push_back(factor.levels[static_cast<std::size_t>(level)]);
        const bool has_words = std::ranges::any_of(column.of_entry, [](const FactorLevel& level) {
            return !level.number && level.name != no_level;
        });
        column.what.format = has_words ? "string" : "number";
        columns.push_back(std::move(column));
    }
    return columns;
}

void put_level(TableCells& to, const FactorLevel& level) {
    if (level.number)
        to.ready(level.name);
    else if (level.name == no_level)
        to.missing();
    else
        to.text(level.name);
}

std::string level_cell(const FactorLevel& level, TableFormat format) {
    return level.number ? level.name : text_cell(level.name == no_level ? "" : level.name, format);
}

SharedColumns::SharedColumns(const SessionHeader& header)
    : trial{"trial", "Position of the trial in the observer's order, from 1"},
      task{"task", "Which question was asked"}, slot{"slot",
                                                     "Slot of the screen in which it was; n/a: in none"},
      angle{"angle_deg", "Turn of the object in the frame shown, counter-clockwise seen from above", "deg"},
      stimulus(stimulus_columns_of(header)), has_slots(header.slots.size() > 1) {
    for (const RecordedSlot& entry : header.slots)
        slot.levels.emplace_back(entry.id, plain_line_of(entry.title));
    for (const RecordedTask& entry : header.tasks)
        task.levels.emplace_back(entry.id, plain_line_of(entry.question));
}

TableColumn session_seconds(std::string name, const std::string& meaning) {
    return {std::move(name), meaning + "; session clock, nine decimals keep each nanosecond", "s"};
}

} // namespace overt
