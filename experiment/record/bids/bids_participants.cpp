#include "experiment/record/bids/bids_participants.h"

#include <algorithm>
#include <sstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "experiment/base/error.h"
#include "experiment/base/json_text.h"
#include "experiment/base/plain_text.h"
#include "experiment/base/whole_file.h"
#include "experiment/record/tables/export_tables.h"
#include "experiment/record/tables/participant_rows.h"
#include "experiment/record/tables/table_writer.h"

namespace fs = std::filesystem;

namespace overt {
namespace {

using Cells = std::vector<std::string>;

Cells cells_of(const std::string& line) {
    Cells cells;
    std::istringstream stream(line + '\t');
    for (std::string cell; std::getline(stream, cell, '\t');)
        cells.push_back(cell);
    return cells;
}

/// Rows of text, the names of the columns first.
struct Participants {
    Cells names{"participant_id", "species", "age", "sex", "handedness"};
    std::vector<Cells> rows;

    explicit Participants(const fs::path& file) {
        if (!fs::exists(file))
            return;
        std::istringstream text(read_whole_file(file));
        std::string line;
        if (!std::getline(text, line) || !line.starts_with("participant_id"))
            throw InputError(fmt::format("{}: is no table of participants: its first column must be "
                                         "participant_id.",
                                         file.string()));
        names = cells_of(line);
        while (std::getline(text, line)) {
            rows.push_back(cells_of(line));
            if (rows.back().size() != names.size())
                throw InputError(fmt::format("{}:{}: has {} cells instead of {}.", file.string(),
                                             rows.size() + 1, rows.back().size(), names.size()));
        }
    }

    std::size_t column(const std::string& name) {
        const auto found = std::find(names.begin(), names.end(), name);
        if (found != names.end())
            return static_cast<std::size_t>(found - names.begin());
        names.push_back(name);
        for (Cells& row : rows)
            row.push_back("n/a");
        return names.size() - 1;
    }
    Cells& row(const std::string& id) {
        for (Cells& row : rows)
            if (row.front() == id)
                return row;
        rows.emplace_back(names.size(), "n/a").front() = id;
        return rows.back();
    }
    std::string text() const {
        std::string text;
        const auto add = [&](const Cells& cells) {
            for (std::size_t i = 0; i < cells.size(); ++i)
                text += (i > 0 ? "\t" : "") + cells[i];
            text += '\n';
        };
        add(names);
        for (const Cells& row : rows)
            add(row);
        return text;
    }
};

/// Ages and the like that BIDS knows by certain words only.
bool is_usual_value(const std::string& name, const std::string& value) {
    const TableColumn column = participant_column(name, "");
    return column.levels.empty() || std::any_of(column.levels.begin(), column.levels.end(),
                                                [&](const auto& level) { return level.first == value; });
}

} // namespace

std::vector<std::string> add_bids_participant(const fs::path& dataset, const SessionRecord& record) {
    const fs::path table_file = dataset / "participants.tsv", json_file = dataset / "participants.json";
    const ParticipantRow participant = participant_row(record);
    const std::string id = participant.id();
    Participants participants(table_file);
    nlohmann::ordered_json json = nlohmann::ordered_json::object();
    if (fs::exists(json_file)) {
        json = parse_json(read_whole_file(json_file));
        if (!json.is_object())
            throw InputError(fmt::format("{}: is no JSON.", json_file.string()));
    }
    std::vector<std::string> remarks;
    const auto set = [&](const std::string& name, const std::string& title, const std::string& value) {
        const std::size_t column = participants.column(name);
        std::string& cell = participants.row(id)[column];
        const std::string text = text_cell(value, TableFormat::tsv);
        if (cell == "n/a")
            cell = text;
        else if (text != "n/a" && cell != text)
            remarks.push_back(
                fmt::format("{}: {} is {} in participants.tsv, and {} in this session: the table "
                            "stays as it is.",
                            id, name, cell, text));
        if (!json.contains(name))
            json.update(describe_columns({participant_column(name, title)}, TableFormat::tsv));
    };
    set("participant_id", "", id);
    set("species", "", "homo sapiens");
    for (const char* name : {"age", "sex", "handedness"})
        set(name, "", "");
    for (const RecordedObserverField& field : participant.fields) {
        if (is_usual_value(field.id, field.value))
            set(field.id, plain_line_of(field.title), field.value);
        else
            remarks.push_back(
                fmt::format("{}: {} is \"{}\" in this session, which BIDS does not know: left out.", id,
                            field.id, field.value));
    }
    write_whole_file(table_file, participants.text());
    write_whole_file(json_file, json_text(json));
    return remarks;
}

} // namespace overt
