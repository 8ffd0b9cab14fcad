#include "experiment/keys/toml_remedy.h"

#include <catch2/catch.hpp>

#include "experiment/keys/toml_tree.h"

using namespace overt;
using Catch::StartsWith;

namespace {

/// The hint of the first finding in a text.
std::string hint_for(const std::string& text) {
    Diagnostics diagnostics;
    parse_toml(text, "t.toml", diagnostics);
    REQUIRE_FALSE(diagnostics.findings().empty());
    return diagnostics.findings().front().hint;
}

} // namespace

TEST_CASE("what mends a line is told from what stands at the place of the error", "[unit]") {
    const std::string text = "a text stands between quotation marks: ",
                      marks = "the text is not closed: a quotation mark is missing";
    const std::pair<std::string, std::string> slips[] = {
        {"a = words", text + "\"words\""},
        {"a = task # t begins true", text + "\"task\""},
        {"a = native-8bit", text + "\"native-8bit\""},
        {"a = [\"one\", two]", text + "\"two\""},
        {"a = [\"one\",\n  two]", text + "\"two\""},
        {"a = { b = cone }", text + "\"cone\""},
        {"a =", "the value is missing"},
        {"a = # nothing", "the value is missing"},
        {"a = ‘x’", "texts stand between straight quotation marks"},
        {"a = TRUE", "true and false are written in small letters"},
        {"a = [true, False]", "true and false are written in small letters"},
        {"a = 1,5", "numbers have a point, not a comma"},
        {"a = -.5", "write a 0 before the point"},
        {"a = [1, .5]", "write a 0 before the point"},
        {"a = 007", "leave the first 0 out"},
        {"a = \"no end", marks},
        {"a = [\"x\", \"no end]", marks},
        {"a = \"\"\"\nno end\n", marks},
        {"a b = 1", "write the key, =, and its value"},
        {"a: 1", "write the key, =, and its value"},
        {"[a", "a section is [name] on a line of its own"},
        {"[[a]", "a section is [name] on a line of its own"},
        {"[a] b = 1", "a section is [name] on a line of its own"},
        {"a = [1,\n2\n[b]", "a list above is not closed"},
        {"a = [1,\n2\nb = 3", "a list above is not closed"},
        {"[a]\n[b]\n[ a ] # again", "join the two"},
        {"[[a]]\n[a]", "write the heading of each entry with two brackets"},
        {"[a]\nb = \"c # d\" # e\nb = 2", "a key is set once in a section"},
        {"a = [1]\na = [2]", "a key is set once in a section"},
        {"a = \"\xff\"", "save the file as UTF-8"}};
    for (const auto& [slip, remedy] : slips) {
        CAPTURE(slip);
        CHECK_THAT(hint_for(slip + "\n"), StartsWith(remedy));
    }
}

TEST_CASE("an error that no slip explains has no remedy", "[unit]") {
    for (const std::string slip : {"a = 12px", "a = \"C:\\dir\"", "a = 1979-13-45", "a = true true"}) {
        CAPTURE(slip);
        CHECK(hint_for(slip + "\n").empty());
    }
    CHECK(hint_for("[a]\nb = 1\n[c]\nb = 1\nd = 0x\n").empty()); // b is set once in each section
}
