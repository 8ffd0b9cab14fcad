#include "experiment/keys/delimited_text.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

using namespace overt;

namespace {

struct ParsedTable {
    explicit ParsedTable(std::string_view text) : table(parse_delimited(text, "list.tsv", 0, diagnostics)) {}

    std::vector<std::vector<std::string>> cells() const {
        std::vector<std::vector<std::string>> all;
        for (const auto& row : table.value().rows) {
            all.emplace_back();
            for (const TextCell& cell : row)
                all.back().push_back(cell.text);
        }
        return all;
    }
    std::vector<std::string> lines() const {
        std::vector<std::string> lines;
        for (const Finding& finding : diagnostics.findings())
            lines.push_back(
                fmt::format("{}:{}: {}", finding.place.line, finding.place.column, finding.message));
        return lines;
    }
    Diagnostics diagnostics;
    std::optional<DelimitedText> table;
};

using Rows = std::vector<std::vector<std::string>>;
using Lines = std::vector<std::string>;

} // namespace

TEST_CASE("a table is the same between commas, semicolons and tabs, and with any line ends", "[unit]") {
    const Rows expected{{"a", "0.5"}, {"b", ""}};
    for (const char* separator : {",", ";", "\t", " ; "}) {
        for (const char* end : {"\n", "\r\n", "\r"}) {
            const std::string text = fmt::format("object{0}blank_s{1}a{0}0.5{1}{1}b{0}", separator, end);
            CHECK(ParsedTable(text).cells() == expected);
            CHECK(ParsedTable("\xef\xbb\xbf" + text + end).cells() == expected);
        }
    }
}

TEST_CASE("quotes hold separators, line ends and quotes; places count characters", "[unit]") {
    const ParsedTable parsed("name,said,x\n\"Müller, A.\" , \"a \"\"b\"\"\nc\",7\n");
    CHECK(parsed.cells() == Rows{{"Müller, A.", "a \"b\"\nc", "7"}});
    const std::vector<TextCell>& row = parsed.table->rows.front();
    CHECK(row[0].place == Place{2, 1, 0});
    CHECK(row[1].place == Place{2, 16, 0});
    CHECK(row[2].place == Place{3, 4, 0});
}

TEST_CASE("numbers between semicolons may have a comma", "[unit]") {
    const ParsedTable parsed("a;b\n0,5;1.5\n");
    CHECK(number_in_cell(*parsed.table, parsed.table->rows[0][0]) == 0.5);
    CHECK(number_in_cell(*parsed.table, parsed.table->rows[0][1]) == 1.5);
    const ParsedTable words("a\nnan\n1e999\n5 s\n");
    for (const auto& row : words.table->rows)
        CHECK_FALSE(number_in_cell(*words.table, row[0]));
}

TEST_CASE("all that is wrong with a table is found at once, each at its place", "[unit]") {
    CHECK(ParsedTable("a,b,a,\n1,2,3,4\n1,2,3\n1,2,3,4,5\n").lines() ==
          Lines{"1:5: two columns are called \"a\"", "1:7: a column without a name",
                "3:1: 3 cells in this row, 4 in the header", "4:1: 5 cells in this row, 4 in the header"});
    CHECK(ParsedTable("a,b\n\"x\"y,2\n1,\"2\n3\n").lines() ==
          Lines{"2:4: more text after the quote that ends the cell", "3:3: this quote is never closed"});
    CHECK(ParsedTable("a,b\n").lines() == Lines{"1:1: the table has no rows below its header"});
    CHECK(ParsedTable("").lines() == Lines{"1:1: the table is empty"});
    CHECK(ParsedTable("a,b\n\xe4,2\n").lines() == Lines{"1:1: the table is not UTF-8"});
    CHECK(ParsedTable(std::string_view("\xff\xfe"
                                       "a\0,\0",
                                       6))
              .lines() == Lines{"1:1: the table is not UTF-8"});
}
