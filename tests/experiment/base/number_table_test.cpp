#include "experiment/base/number_table.h"

#include <catch2/catch.hpp>

using namespace overt;

TEST_CASE("a table's lines and cells know their places", "[unit]") {
    TableLines lines("\xEF\xBB\xBF# a note\n\n  name , ä,b\r\n 1,2.5 ,x\n");
    REQUIRE(lines.next());
    CHECK(lines.number() == 3);
    REQUIRE(lines.cells().size() == 3);
    CHECK(lines.cells()[0].text == "name");
    CHECK(lines.cells()[2].text == "b");
    CHECK(lines.cells()[2].place == Place{3, 12});
    CHECK_FALSE(lines.cells()[0].number());
    REQUIRE(lines.next());
    CHECK(lines.text() == " 1,2.5 ,x");
    CHECK(lines.cells()[0].number() == 1.0);
    CHECK(lines.cells()[1].number() == 2.5);
    CHECK_FALSE(lines.next());
}

TEST_CASE("quotes around a cell, as R and spreadsheets write them, are not of its text", "[unit]") {
    TableLines lines("\"name\", \"left, right\" ,\"\",\"a\" b,\"c\n\"1.5\",\"\"2\"\",\"3\n");
    REQUIRE(lines.next());
    REQUIRE(lines.cells().size() == 5);
    CHECK(lines.cells()[0].text == "name");
    CHECK(lines.cells()[0].place == Place{1, 2});
    CHECK(lines.cells()[1].text == "left, right");
    CHECK(lines.cells()[1].place == Place{1, 10});
    CHECK(lines.cells()[2].text.empty());
    CHECK(lines.cells()[3].text == "\"a\" b"); // not a quoted cell
    CHECK(lines.cells()[4].text == "\"c");     // never closed
    REQUIRE(lines.next());
    CHECK(lines.cells()[0].number() == 1.5);
    CHECK_FALSE(lines.cells()[1].number());
    CHECK_FALSE(lines.cells()[2].number());
}

TEST_CASE("what is no finite number as a whole is none", "[unit]") {
    for (const std::string_view text : {"", "1x", "1 2", "inf", "nan", "1e999", "+1"}) {
        CAPTURE(text);
        CHECK_FALSE(TableCell{text, {}}.number());
    }
    CHECK(TableCell{"-1e-3", {}}.number() == -0.001);
}

TEST_CASE("columns come by name in any order, and what is wrong has its place", "[unit]") {
    const std::string_view required[] = {"a", "b"}, optional[] = {"c"};
    Diagnostics diagnostics;
    const auto table = read_number_table("b,a\n1,2\n3,4\n", "t.csv", required, optional, diagnostics);
    REQUIRE(table);
    CHECK(table->column("a") == std::vector<double>{2.0, 4.0});
    CHECK_FALSE(table->has("c"));
    CHECK(table->place(1, "a") == Place{3, 3});
    CHECK_FALSE(read_number_table("a,b\n1,2\n1;2\n1,é\n", "u.csv", required, optional, diagnostics));
    const auto findings = diagnostics.findings();
    REQUIRE(findings.size() == 2);
    CHECK(findings[0].place == Place{3, 1});
    CHECK(findings[0].hint == "write commas between columns, and points for decimals");
    CHECK(findings[1].place == Place{4, 3});
    CHECK(findings[1].message == "\"é\" is no number");
}

TEST_CASE("a table within the program gives its rows", "[unit]") {
    CHECK(rows_of_table("# of whom\nx,y\n1,2\n3,4.5\n", 2) ==
          std::vector<std::vector<double>>{{1.0, 2.0}, {3.0, 4.5}});
}
