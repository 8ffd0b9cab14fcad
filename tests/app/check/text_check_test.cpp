#include "app/check/text_check.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "tests/experiment/protocol/protocol_fixtures.h"

using namespace overt;
using namespace overt::test;

namespace {

std::vector<Finding> findings_of(const std::string& more) {
    ReadText read(minimal_protocol, more);
    REQUIRE(read.protocol);
    Diagnostics diagnostics;
    check_texts(*read.protocol, diagnostics);
    return diagnostics.findings();
}

} // namespace

TEST_CASE("a text that would be cut off is an error, one that is set smaller a warning", "[unit]") {
    std::string lines;
    for (int line = 0; line < 60; ++line)
        lines += "line\\n";
    const auto smaller = findings_of("[instructions]\npages = [\"short\", \"" + lines + "\"]\n");
    REQUIRE(smaller.size() == 1);
    CHECK(smaller[0].severity == Severity::warning);
    CHECK_THAT(smaller[0].message, Catch::StartsWith("page 2: too long for the screen: it will be set in"));
    CHECK(smaller[0].place.line == 13);
    std::string endless;
    for (int times = 0; times < 10; ++times)
        endless += lines;
    const auto cut = findings_of("[consent]\ntext = \"" + endless + "\"\n");
    REQUIRE(cut.size() == 1);
    CHECK(cut[0].severity == Severity::error);
    CHECK_THAT(cut[0].message, Catch::Contains("its end would be cut off"));
}

TEST_CASE("letters that no font has are found in every text that is shown, named by what it is", "[unit]") {
    // From a plane of Unicode that is for private use.
    const std::string unknown = "\"\\U000F0000\"";
    const auto named = [&](const std::string& more) {
        const auto findings = findings_of(more);
        REQUIRE(findings.size() == 1);
        return findings[0].message.substr(0, findings[0].message.find(':'));
    };
    CHECK(named("[operator]\nskip_reasons = [\"tired\", " + unknown + "]\n") == "skip reason 2");
    const std::string field = "[[observer_field]]\nid = \"eyes\"\n";
    CHECK(named(field + "note = " + unknown + "\n") == "the note of field \"eyes\"");
    CHECK(named(field + "kind = \"choice\"\nchoices = [\"blue\", " + unknown + "]\n") == "choice 2");
    CHECK(named("[[task]]\nid = \"age\"\nquestion = " + unknown + "\n") == "the question of task \"age\"");
}

TEST_CASE("texts that hardly differ from their background are warned of, with the ratio", "[unit]") {
    const auto findings = findings_of("[screens]\ntext_grey = 0.04\n");
    REQUIRE(findings.size() == 1);
    CHECK(findings[0].severity == Severity::warning);
    // (0.04 + 0.05) / (0 + 0.05)
    CHECK_THAT(findings[0].message, Catch::Contains("1.8 : 1"));
    CHECK(findings_of("[screens]\ntext_grey = 0.11\n").empty());
}

TEST_CASE("a form that is too large for the screen is found as a whole", "[unit]") {
    std::string fields;
    for (int i = 0; i < 40; ++i)
        fields += fmt::format("[[observer_field]]\nid = \"f{}\"\n", i);
    const auto findings = findings_of(fields);
    REQUIRE(findings.size() == 1);
    CHECK_THAT(findings[0].message, Catch::Contains("the form is too large"));
}

TEST_CASE("emphasis that is not closed is found where it stands", "[unit]") {
    const auto findings = findings_of("[screens]\nwelcome_text = \"<b>Hello\"\n");
    REQUIRE(findings.size() == 1);
    CHECK(findings[0].severity == Severity::error);
    CHECK_THAT(findings[0].message, Catch::Contains("<b> is not closed"));
    CHECK(findings[0].place.line == 13);
}
