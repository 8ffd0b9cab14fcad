#include "experiment/record/tables/table_writer.h"

#include <fstream>
#include <limits>
#include <sstream>

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "tests/support/temporary_folder.h"

using namespace overt;
using namespace overt::test;
using json = nlohmann::ordered_json;

namespace {

const Table mixed_table{"mixed",
                        "One column for each kind of cell.",
                        {{"text", "", "", {}},
                         {"first \"half\"", "", "", {}},
                         {"second half", "", "", {}},
                         {"word", "", "", {}},
                         {"integer", "", "", {}},
                         {"fixed", "", "", {}},
                         {"seconds", "", "", {}},
                         {"missing", "", "", {}}}};

const std::vector<std::string> texts{"plain",       "tab\there",       "line\nbreak\r", "a \"quoted\" word",
                                     "back\\slash", "Wie alt? 何歳？", "n/a",           ""};

/// The table's lines.
std::vector<std::string> written(const TemporaryFolder& folder, TableFormat format) {
    TableWriter row(folder.path(), mixed_table, format);
    for (int i = 0; i < 40; ++i) {
        const std::string &text = texts[static_cast<std::size_t>(i) % texts.size()],
                          &other = texts[static_cast<std::size_t>(i / 8) % texts.size()];
        row.text(text)
            .ready(text_cell(other, format))
            .ready(text_cell(text, format))
            .word(i % 2 ? "yes" : "no");
        row.integer(1 - i * 1'000'003LL);
        row.fixed(i % 5 == 4 ? std::numeric_limits<double>::quiet_NaN() : 0.1 * i - 1.0, 3);
        row.seconds(SessionDuration{i * 123'456'789LL - 7}).missing().end_row();
    }
    CHECK(row.rows() == 40);
    row.close();
    std::ifstream file(folder.path() / fmt::format("mixed.{}", ending_of(format)));
    std::vector<std::string> lines;
    for (std::string line; std::getline(file, line);)
        lines.push_back(line);
    return lines;
}

std::vector<std::string> cells_of(const std::string& line) {
    std::vector<std::string> cells;
    std::istringstream in(line);
    for (std::string cell; std::getline(in, cell, '\t');)
        cells.push_back(cell);
    return cells;
}

} // namespace

TEST_CASE(
    "lines of JSON hold the cells of tabbed lines: texts as they were, numbers as numbers, null for nothing",
    "[unit]") {
    const TemporaryFolder folder;
    const auto tabbed = written(folder, TableFormat::tsv), objects = written(folder, TableFormat::jsonl);
    REQUIRE(tabbed.size() == 41); // with the line of names
    REQUIRE(objects.size() == 40);
    for (std::size_t i = 0; i < objects.size(); ++i) {
        CAPTURE(objects[i]);
        const json object = json::parse(objects[i]);
        const auto cells = cells_of(tabbed[i + 1]);
        REQUIRE(object.size() == mixed_table.columns.size());
        std::size_t column = 0;
        for (const auto& [name, value] : object.items()) {
            CAPTURE(name);
            CHECK(name == mixed_table.columns[column].name);
            const std::string& cell = cells[column];
            if (value.is_string())
                CHECK(text_cell(value.get<std::string>(), TableFormat::tsv) == cell);
            else if (value.is_number())
                CHECK(value.get<double>() == std::stod(cell));
            else
                CHECK((value.is_null() && cell == "n/a"));
            CHECK(value.is_number() == ((column >= 4 && column <= 6) && cell != "n/a"));
            ++column;
        }
        // A text n/a is told from nothing.
        CHECK(object["text"] == (texts[i % texts.size()].empty() ? json() : json(texts[i % texts.size()])));
    }
}

TEST_CASE("a text that is no UTF-8 is still a line of JSON", "[unit]") {
    CHECK(json::parse(text_cell("caf\xe9", TableFormat::jsonl)) == "caf\xef\xbf\xbd");
}

TEST_CASE("a cell of a csv with any end of line, comma or quote stands in quotes", "[unit]") {
    CHECK(text_cell("a b", TableFormat::csv) == "a b");
    for (const char* const text : {"a,b", "a\nb", "a\rb", "a\r\nb", "\r"})
        CHECK(text_cell(text, TableFormat::csv) == "\"" + std::string(text) + "\"");
    CHECK(text_cell("a\"b", TableFormat::csv) == "\"a\"\"b\"");
}
