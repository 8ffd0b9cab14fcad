/// What stands in the files of an export: the dictionary, and the same cells in every format.
#include "experiment/record/tables/table_export.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>
#include <vector>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "experiment/base/error.h"
#include "experiment/record/session_schema.h"
#include "experiment/record/tables/export_tables.h"
#include "experiment/record/tables/table_writer.h"
#include "tests/experiment/record/tables/recorded_trials.h"

using namespace overt;
using namespace overt::testing;
using Catch::Matchers::Contains;

TEST_CASE("the dictionary explains each column of each file, in the files' order", "[unit]") {
    const Recorded recorded;
    export_tables(SessionRecord(recorded.session), bust_only, recorded.target());
    const auto dictionary = nlohmann::ordered_json::parse(text_of(recorded.target() / "dictionary.json"));
    REQUIRE(dictionary["Files"].size() == 19);
    for (const auto& [file, description] : dictionary["Files"].items()) {
        std::vector<std::string> explained;
        for (const auto& [column, entry] : description["Columns"].items()) {
            explained.push_back(column);
            CHECK_FALSE(entry["Description"].get<std::string>().empty());
        }
        const auto rows = rows_of(recorded.target() / file);
        CHECK(explained == rows[0]);
        // Where values are listed, no other occurs.
        for (std::size_t column = 0; column < explained.size(); ++column) {
            const auto& entry = description["Columns"][explained[column]];
            for (std::size_t i = 1; entry.contains("Levels") && i < rows.size(); ++i)
                REQUIRE((rows[i][column] == "n/a" || entry["Levels"].contains(rows[i][column])));
        }
    }
}

/// Cells of comma-separated text, read as RFC 4180 has it.
std::vector<std::vector<std::string>> comma_separated(const std::string& text) {
    std::vector<std::vector<std::string>> rows{{""}};
    bool in_quotes = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (c == '"' && in_quotes && i + 1 < text.size() && text[i + 1] == '"') {
            rows.back().back() += text[++i];
        } else if (c == '"') {
            in_quotes = !in_quotes;
        } else if (c == ',' && !in_quotes) {
            rows.back().emplace_back();
        } else if (c == '\n' && !in_quotes) {
            rows.push_back({""});
        } else {
            rows.back().back() += c;
        }
    }
    rows.pop_back();
    return rows;
}

/// Whether a row of the table is this JSON object. A column holds numbers or texts in all rows alike.
void check_is_row(const nlohmann::ordered_json& object, const std::vector<std::string>& names,
                  const std::vector<std::string>& cells, std::map<std::string, bool>& holds_numbers) {
    REQUIRE(object.size() == names.size());
    std::size_t column = 0;
    for (const auto& [name, value] : object.items()) {
        CAPTURE(name, value, cells[column]);
        REQUIRE(name == names[column]);
        const std::string& cell = cells[column++];
        REQUIRE(value.is_null() == (cell == "n/a"));
        if (value.is_null())
            continue;
        REQUIRE(holds_numbers.try_emplace(name, value.is_number()).first->second == value.is_number());
        REQUIRE((value.is_number() ? value.get<double>() == std::stod(cell) : value == cell));
    }
}

TEST_CASE("commas and JSON hold the same cells as tab-separated tables, with their texts as they were",
          "[unit]") {
    const Recorded recorded({20});
    const SessionRecord record(recorded.session);
    export_tables(record, bust_only, recorded.root.path() / "tsv");
    export_tables(record, bust_only, recorded.root.path() / "jsonl", {TableFormat::jsonl, false, {}, {}});
    const auto counts =
        export_tables(record, bust_only, recorded.root.path() / "csv", {TableFormat::csv, false, {}, {}});
    const auto unescaped = [](std::string cell) {
        for (const auto& [escape, character] : {std::pair{"\\t", "\t"}, {"\\n", "\n"}, {"\\r", "\r"}})
            for (auto at = cell.find(escape); at != std::string::npos; at = cell.find(escape))
                cell.replace(at, 2, character);
        return cell;
    };
    std::int64_t rows = 0, quoted = 0;
    std::map<std::string, bool> holds_numbers; // by column, in all tables alike
    for (const char* name : {"trials", "flips", "samples", "gaze_events", "events", "responses", "stimuli",
                             "display_box", "participants"}) {
        auto expected = rows_of(recorded.root.path() / "tsv" / (std::string(name) + ".tsv"));
        for (auto& row : expected)
            for (std::string& cell : row)
                cell = unescaped(cell);
        const std::string text = text_of(recorded.root.path() / "csv" / (std::string(name) + ".csv"));
        quoted += text.find('"') != std::string::npos;
        REQUIRE(comma_separated(text) == expected);
        rows += static_cast<std::int64_t>(expected.size()) - 1;
        std::istringstream objects(text_of(recorded.root.path() / "jsonl" / (std::string(name) + ".jsonl")));
        std::size_t row = 1;
        for (std::string line; std::getline(objects, line); ++row) {
            REQUIRE(row < expected.size());
            check_is_row(nlohmann::ordered_json::parse(line), expected[0], expected[row], holds_numbers);
        }
        CHECK(row == expected.size());
    }
    CHECK(quoted > 0);
    for (const char* column :
         {"session", "trial", "attempt", "refresh", "time_s", "x_px", "surface_z", "planned_frame"})
        CHECK(holds_numbers.at(column));
    CHECK_FALSE(holds_numbers.at("task"));
    CHECK_FALSE(holds_numbers.at("observer"));
    CHECK(counts.rows == rows);
    const auto dictionary = nlohmann::json::parse(text_of(recorded.root.path() / "csv" / "dictionary.json"));
    CHECK(dictionary["Files"].contains("samples.csv"));
}

TEST_CASE("texts with commas, quotes, line breaks and blanks at their ends stand in quotes", "[unit]") {
    CHECK(text_cell("a,b", TableFormat::csv) == "\"a,b\"");
    CHECK(text_cell("say \"no\"", TableFormat::csv) == "\"say \"\"no\"\"\"");
    CHECK(text_cell("a\nb", TableFormat::csv) == "\"a\nb\"");
    CHECK(text_cell(" a", TableFormat::csv) == "\" a\"");
    CHECK(text_cell("", TableFormat::csv) == "n/a");
    CHECK(text_cell("Wie alt? 何歳？ كم عمره؟", TableFormat::csv) == "Wie alt? 何歳？ كم عمره؟");
}

TEST_CASE("cells keep their numbers to the last decimal, and texts in one cell", "[unit]") {
    const TemporaryFolder root;
    TableWriter writer(root.path(), {"t", "", {{"a", "", "", {}}, {"b", "", "", {}}}}, TableFormat::tsv);
    const auto row = [&](auto&& first, auto&& second) {
        first(), second();
        writer.end_row();
    };
    row([&] { writer.seconds(SessionDuration(-1)); },
        [&] { writer.seconds(SessionDuration(1'234'567'890'123)); });
    row([&] { writer.fixed(-0.0004, 3); }, [&] { writer.fixed(-1.0005, 3); });
    row([&] { writer.fixed(std::nan(""), 3); },
        [&] { writer.fixed(-std::numeric_limits<double>::infinity(), 1); });
    row([&] { writer.fixed(1e17, 2); }, [&] { writer.integer(std::numeric_limits<std::int64_t>::min()); });
    row([&] { writer.text(""); }, [&] { writer.text("a\tb\\c\r\n"); });
    CHECK(writer.rows() == 5);
    writer.close();
    CHECK(text_of(root.path() / "t.tsv") == "a\tb\n"
                                            "-0.000000001\t1234.567890123\n"
                                            "0.000\t-1.001\n"
                                            "n/a\tn/a\n"
                                            "100000000000000000.00\t-9223372036854775808\n"
                                            "n/a\ta\\tb\\\\c\\r\\n\n");
}
