/// Texts of strangers on terminals and in spreadsheets.
#include "experiment/base/safe_text.h"

#include <catch2/catch.hpp>

using namespace overt;

TEST_CASE("what a terminal would take for a command becomes visible", "[unit]") {
    CHECK(printable_text("\x1b[2Jgone\a\r") == "\\x1b[2Jgone\\x07\\x0d");
    CHECK(printable_text("two\nlines\tand a tab") == "two\nlines\tand a tab");
    CHECK(printable_text("\xc2\x9b"
                         "31m \x7f") == "\\x9b31m \\x7f");
    CHECK(printable_text("\xe2\x80\xae"
                         "reversed\xe2\x81\xa6") == "\\u202ereversed\\u2066");
    for (const char* const shown : {"grün ± 3 µm – „so“", "\xc2\xa0", "שלום", "日本", "\xe2\x80\x8f", ""})
        CHECK(printable_text(shown) == shown);
    CHECK(printable_text(std::string_view("\0", 1)) == "\\x00");
    CHECK(printable_text("\xe2") == "\xe2"); // cut off
}

TEST_CASE("a cell is no formula, and a number stays a number", "[unit]") {
    CHECK(without_formula("=1+1") == "'=1+1");
    CHECK(without_formula("-12.5 3.25") == "-12.5 3.25");
    CHECK(without_formula("-12.5 A1") == "'-12.5 A1");
    CHECK(without_formula("@SUM(A1)") == "'@SUM(A1)");
    CHECK(without_formula("+cmd|' /C calc'!A0") == "'+cmd|' /C calc'!A0");
    CHECK(without_formula("-2+3") == "'-2+3");
    CHECK(without_formula("\t=1") == "'\t=1");
    for (const char* const same :
         {"-1.5", "+3", "-2e-7", "-inf", "-", "+", "=", "@", "", "a=b", "n/a", " =x"})
        CHECK(without_formula(same) == same);
}

TEST_CASE("a cell of a CSV file holds commas, quotes and line breaks", "[unit]") {
    CHECK(csv_cell("plain") == "plain");
    CHECK(csv_cell("a \"b\"") == "\"a \"\"b\"\"\"");
    CHECK(csv_cell("a,b") == "\"a,b\"");
    CHECK(csv_cell("a\nb") == "\"a\nb\"");
    CHECK(csv_cell(" a") == "\" a\"");
    CHECK(csv_cell("=HYPERLINK(\"x\")") == "\"'=HYPERLINK(\"\"x\"\")\"");
    CHECK(csv_cell("") == "");
}
