#include "experiment/base/diagnostics.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using namespace overt;

namespace {

constexpr std::string_view known[] = {"viewing_distance_mm", "refresh_hz", "width_px", "height_px"};

} // namespace

TEST_CASE("findings print as compilers print them, with line, caret and hint", "[unit]") {
    Diagnostics diagnostics;
    diagnostics.quote_from("a.toml", "one = 1\nrefresh_hz = 100\n");
    diagnostics.error("a.toml", {2, 14}, "that is too slow", "take 120");
    CHECK(diagnostics.print() == "a.toml:2:14: error: that is too slow\n"
                                 "    2 | refresh_hz = 100\n"
                                 "      |              ^\n"
                                 "      = take 120\n"
                                 "1 error, 0 warnings\n");
}

TEST_CASE("the caret stands under its character after tabs, accents and wide letters", "[unit]") {
    Diagnostics diagnostics;
    diagnostics.quote_from("a.toml", "\té = 1\n書 = 2\r\ne\xCC\x81 = 3\n");
    diagnostics.warning("a.toml", {1, 6}, "after a tab");
    diagnostics.warning("a.toml", {2, 5}, "after a wide letter");
    diagnostics.warning("a.toml", {3, 6}, "after a combining accent");
    CHECK(diagnostics.print() == "a.toml:1:6: warning: after a tab\n"
                                 "    1 | \té = 1\n"
                                 "      | \t    ^\n"
                                 "a.toml:2:5: warning: after a wide letter\n"
                                 "    2 | 書 = 2\n"
                                 "      |      ^\n"
                                 "a.toml:3:6: warning: after a combining accent\n"
                                 "    3 | e\xCC\x81 = 3\n"
                                 "      |     ^\n"
                                 "0 errors, 3 warnings\n");
}

TEST_CASE("findings come in the order of their places, those at one place as they were found", "[unit]") {
    Diagnostics diagnostics;
    diagnostics.error("b.toml", {1, 1}, "fifth");
    diagnostics.error("a.toml", {9, 1}, "fourth");
    diagnostics.warning("a.toml", {2, 7}, "second");
    diagnostics.error("a.toml", {2, 7}, "third");
    diagnostics.error("a.toml", {}, "first");
    std::vector<std::string> messages;
    for (const Finding& finding : diagnostics.findings())
        messages.push_back(finding.message);
    CHECK(messages == std::vector<std::string>{"first", "second", "third", "fourth", "fifth"});
    CHECK(diagnostics.error_count() == 4);
    CHECK(diagnostics.warning_count() == 1);
}

TEST_CASE("warnings alone are no errors, and nothing found prints nothing", "[unit]") {
    Diagnostics diagnostics;
    CHECK(diagnostics.print().empty());
    diagnostics.warning("a.toml", {1, 1}, "hm");
    CHECK_FALSE(diagnostics.has_errors());
    diagnostics.error("a.toml", {1, 1}, "no");
    CHECK(diagnostics.has_errors());
}

TEST_CASE("a finding on a whole file, or beyond its end, quotes no line", "[unit]") {
    Diagnostics diagnostics;
    diagnostics.quote_from("a.toml", "x = 1");
    diagnostics.error("a.toml", {}, "cannot be read");
    diagnostics.error("a.toml", {7, 1}, "beyond");
    CHECK(diagnostics.print() ==
          "a.toml: error: cannot be read\na.toml:7:1: error: beyond\n2 errors, 0 warnings\n");
}

TEST_CASE("bytes that are no text reach neither the terminal nor the JSON", "[unit]") {
    Diagnostics diagnostics;
    diagnostics.quote_from("a.toml", "x = \"\x1b[31m\xff\"");
    diagnostics.error("a.toml", {1, 5}, "odd \xff\x1b text");
    CHECK(diagnostics.print().find('\x1b') == std::string::npos);
    CHECK(diagnostics.print().find('\xff') == std::string::npos);
    CHECK(diagnostics.to_json().dump().find("odd ?? text") != std::string::npos);
}

TEST_CASE("the JSON form holds what print shows", "[unit]") {
    Diagnostics diagnostics;
    diagnostics.error("a.toml", {2, 14}, "too slow", "take 120");
    const auto json = diagnostics.to_json();
    CHECK(json["errors"] == 1);
    CHECK(json["warnings"] == 0);
    CHECK(json["findings"][0] == nlohmann::ordered_json{{"severity", "error"},
                                                        {"file", "a.toml"},
                                                        {"line", 2},
                                                        {"column", 14},
                                                        {"message", "too slow"},
                                                        {"hint", "take 120"}});
}

TEST_CASE("a misspelt name is recognised by its letters, a name without its unit by its beginning",
          "[unit]") {
    CHECK(nearest_name("viewing_distnace_mm", known) == "viewing_distance_mm");
    CHECK(nearest_name("Refresh_Hz", known) == "refresh_hz");
    CHECK(nearest_name("refresh", known) == "refresh_hz");
    CHECK(nearest_name("widht_px", known) == "width_px");
    CHECK_FALSE(nearest_name("question", known));
    CHECK_FALSE(nearest_name("", known));
    CHECK_FALSE(nearest_name(std::string(100'000, 'x'), known));
}

TEST_CASE("an unknown name brings the nearest known one, or else all of them", "[unit]") {
    CHECK(suggest_name("hight_px", known) == "did you mean \"height_px\"?");
    CHECK(suggest_name("question", known) == "known: viewing_distance_mm, refresh_hz, width_px, height_px");
    CHECK(suggest_name("question", {}).empty());
}
