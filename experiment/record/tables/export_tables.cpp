#include "experiment/record/tables/export_tables.h"

#include <nlohmann/json.hpp>

#include "experiment/base/json_text.h"

namespace overt {
namespace {

std::string_view description_of(TableFormat format) {
    switch (format) {
    case TableFormat::tsv:
        return "Tab-separated tables in UTF-8. Missing values are n/a. In texts, tab, newline, "
               "carriage return and backslash are written as \\t, \\n, \\r and \\\\.";
    case TableFormat::csv:
        return "Comma-separated tables in UTF-8. Missing values are n/a. Texts with commas, quotes, line "
               "breaks or blanks at their ends stand in quotes, quotes in them doubled (RFC 4180).";
    case TableFormat::jsonl:
        break;
    }
    return "Tables in UTF-8, a JSON object in each line for each row. Missing values are null.";
}

} // namespace

ExportTables::ExportTables(const SessionHeader& header, const SharedColumns& shared, const PupilWords& pupil,
                           const FurtherColumns& further, const std::string& event_origins,
                           const std::vector<ParticipantRow>& participant)
    : trials(trials_layout(shared, header)), presentations(presentations_layout(shared, header)),
      flips(ledger_layout(shared, header)), samples(samples_layout(shared, header, pupil, further)),
      gaze_events(gaze_events_layout(header, event_origins, pupil)), events(events_layout()),
      responses(responses_layout(shared, header)), stimuli(stimuli_layout(shared, header)),
      display_box(display_box_layout()), buttons(buttons_layout()), key_presses(key_presses_layout()),
      markers(markers_layout()), steps(steps_layout(header)),
      given_answers(given_answers_layout(shared, header)), answer_inputs(answer_inputs_layout()),
      points(points_layout(header)), probes(probes_layout(shared, header)),
      gauges(gauges_layout(shared, header)), gauge_changes(gauge_changes_layout()),
      settings(settings_layout(shared, header)), moves(moves_layout(shared, header)),
      turns(turns_layout(shared, header)), courses(courses_layout(shared, header)),
      participants(participants_layout(participant)), has_slots_(shared.has_slots),
      has_points_(!header.points.empty()) {
    const std::vector<LeadingColumn> leading{
        {{"observer", "Label of the observer"}, header.schedule.observer.label},
        {{"session", "Which session of this observer, from 1"}, std::to_string(header.session_number), true}};
    const auto lead = [&](auto&... layouts) { (layouts.lead_with(leading), ...); };
    lead(trials, presentations, flips, samples, gaze_events, events, responses, stimuli, display_box, buttons,
         key_presses, markers, steps, given_answers, answer_inputs, points, probes, gauges, gauge_changes,
         settings, moves, turns, courses);
}

std::vector<const Table*> ExportTables::all() const {
    std::vector<const Table*> tables{
        &trials.table(),        &flips.table(),         &samples.table(),     &gaze_events.table(),
        &events.table(),        &responses.table(),     &stimuli.table(),     &display_box.table(),
        &buttons.table(),       &key_presses.table(),   &markers.table(),     &steps.table(),
        &given_answers.table(), &answer_inputs.table(), &settings.table(),    &moves.table(),
        &turns.table(),         &courses.table(),       &participants.table()};
    if (has_slots_)
        tables.push_back(&presentations.table());
    if (has_points_)
        for (const Table* table : {&points.table(), &probes.table(), &gauges.table(), &gauge_changes.table()})
            tables.push_back(table);
    return tables;
}

nlohmann::ordered_json describe_columns(const std::vector<TableColumn>& columns, TableFormat format) {
    nlohmann::ordered_json description = nlohmann::ordered_json::object();
    for (const TableColumn& column : columns) {
        nlohmann::ordered_json& entry = description[column.name];
        entry["Description"] = column.meaning;
        if (!column.unit.empty())
            entry["Units"] = column.unit;
        // The quotes of a csv and of JSON are no part of the value.
        for (const auto& [value, meaning] : column.levels)
            entry["Levels"][format == TableFormat::tsv ? text_cell(value, format) : value] = meaning;
    }
    return description;
}

void describe_table(nlohmann::ordered_json& dictionary, const Table& table, TableFormat format) {
    const std::vector<TableColumn> columns = table.all_columns();
    nlohmann::ordered_json description = describe_columns(columns, format);
    for (const TableColumn& column : columns)
        if (!column.format.empty())
            description[column.name]["Format"] = column.format;
    dictionary[file_name_of(table, format)] = {{"Description", table.description}, {"Columns", description}};
}

std::string table_dictionary(const ExportTables& tables, TableFormat format) {
    nlohmann::ordered_json dictionary;
    dictionary["Description"] = std::string(description_of(format));
    for (const Table* table : tables.all())
        describe_table(dictionary["Files"], *table, format);
    return json_text(dictionary);
}

} // namespace overt
