#include "experiment/record/tables/participant_rows.h"

#include <algorithm>

#include <fmt/format.h>

#include "experiment/base/plain_text.h"

namespace overt {

TableColumn participant_column(const std::string& name, const std::string& title) {
    if (name == "participant_id")
        return {name, "Which observer"};
    if (name == "species")
        return {name, "Species of the observer"};
    if (name == "age")
        return {name, "Age of the observer", "year"};
    if (name == "sex")
        return {name,
                "Sex as the observer gave it",
                "",
                {{"female", "female"}, {"male", "male"}, {"other", "other, or not to be said"}}};
    if (name == "handedness")
        return {name,
                "Handedness as the observer gave it",
                "",
                {{"left", "left"}, {"right", "right"}, {"ambidextrous", "both alike"}}};
    return {name, title.empty() ? name : title};
}

std::string ParticipantRow::id() const { return fmt::format("sub-{}", observer); }

std::string ParticipantRow::value_of(const std::string& field) const {
    const auto found =
        std::find_if(fields.begin(), fields.end(), [&](const auto& one) { return one.id == field; });
    return found == fields.end() ? std::string() : found->value;
}

ParticipantRow participant_row(const SessionRecord& record) {
    return {record.header().schedule.observer.label, record.header().session_number,
            record.observer_fields()};
}

RowLayout<ParticipantRow> participants_layout(const std::vector<ParticipantRow>& rows) {
    RowLayout<ParticipantRow> layout{
        "participants",
        "Who took part: one row for each session, with what the observer filled in; n/a where a session did "
        "not ask.",
        {
            {{"observer", "Label of the observer"}, &ParticipantRow::observer},
            {{"session", "Which session of this observer, from 1"}, &ParticipantRow::session},
            {participant_column("participant_id", ""), &ParticipantRow::id},
            {participant_column("species", ""), [](auto&) { return "homo sapiens"; }},
        }};
    // In the order of the forms, after what every dataset has.
    std::vector<TableColumn> columns{participant_column("age", ""), participant_column("sex", ""),
                                     participant_column("handedness", "")};
    for (const ParticipantRow& row : rows)
        for (const RecordedObserverField& field : row.fields)
            if (std::none_of(columns.begin(), columns.end(),
                             [&](const TableColumn& column) { return column.name == field.id; }))
                columns.push_back(participant_column(field.id, plain_line_of(field.title)));
    for (TableColumn& column : columns) {
        const std::string name = column.name;
        // A form may have a field of the name of a column that stands here already.
        const std::vector<TableColumn>& there = layout.table().columns;
        if (std::any_of(there.begin(), there.end(), [&](const auto& other) { return other.name == name; }))
            column.name = fmt::format("form_{}", name);
        layout.add<ParticipantRow>({{std::move(column), [name](auto& row) { return row.value_of(name); }}});
    }
    return layout;
}

} // namespace overt
