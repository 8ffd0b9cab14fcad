#include <algorithm>
#include <map>

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/stimulus/object.h"
#include "tests/experiment/protocol/protocol_fixtures.h"

using namespace overt;
using namespace overt::test;

namespace {

std::string with_object(std::string_view keys, std::string_view task = {}) {
    return fmt::format(
        "[protocol]\nname = \"areas\"\n[[object]]\nid = \"vase\"\n{}\n[[material]]\nid = \"gold\"\n"
        "kind = \"smooth-conductor\"\n[[task]]\nid = \"free\"\nquestion = \"Look.\"\n{}\n"
        "[schedule]\nmax_object_run = 0\n",
        keys, task);
}

std::vector<std::string> lines_of(const std::string& text) { return ReadText(text).lines(); }

} // namespace

TEST_CASE("areas are read by their names, as sections or in one line, and a head is one of them", "[unit]") {
    const ReadText read(
        with_object("mesh = \"v.obj\"\nhead = { spheres = [[0, 0, 9, 2]] }\n"
                    "areas = { rim = { boxes = [[[0, 0, 5], [1, 2, 6]]], groups = \"lip\" } }\n"
                    "[object.areas.base]\nplanes = [[[0, 0, 1], [0, 0, -1]]]"));
    // TOML closes a table that is written in one line.
    CHECK_FALSE(read.protocol);
    const ReadText sections(
        with_object("mesh = \"v.obj\"\nhead = { spheres = [[0, 0, 9, 2]] }\n"
                    "[object.areas.rim]\nboxes = [[[0, 0, 5], [1, 2, 6]]]\ngroups = \"lip\"\n"
                    "[object.areas.base]\nplanes = [[[0, 0, 1], [0, 0, -1]]]"));
    INFO(sections.diagnostics.print());
    REQUIRE(sections.protocol);
    const std::vector<PartRegion> regions = area_regions(sections.protocol->objects.at(0));
    REQUIRE(regions.size() == 3);
    std::map<std::string, PartRegion> by_name;
    for (const PartRegion& region : regions)
        by_name.emplace(region.name, region);
    CHECK(by_name.at("head").spheres == std::vector{glm::dvec4(0.0, 0.0, 9.0, 2.0)});
    CHECK(by_name.at("rim").groups == std::vector<std::string>{"lip"});
    CHECK(by_name.at("rim").contains({0.5, 1.0, 5.5}));
    CHECK_FALSE(by_name.at("rim").contains({0.5, 1.0, 4.9}));
    CHECK(by_name.at("rim").contains({9.0, 9.0, 9.0}, "lip"));
    CHECK(by_name.at("base").contains({9.0, 9.0, 1.0}));
    CHECK_FALSE(by_name.at("base").contains({0.0, 0.0, 1.1}));
}

TEST_CASE("what is wrong with areas is said at each place, all at once", "[unit]") {
    const auto lines = lines_of(
        with_object("mesh = \"v.obj\"\n[object.areas]\near = 3\n[object.areas.rim]\n[object.areas.\"a b\"]\n"
                    "boxes = [[[0, 0, 0], [1, 1, 1]]]\n[object.areas.cup]\nboxes = [[[1, 0, 0], [0, 1, 1]]]\n"
                    "[object.areas.lip]\nsphere = [[0, 0, 0, 1]]"));
    const auto has = [&](const char* place, const char* words) {
        return std::ranges::any_of(lines, [&](const std::string& line) {
            return line.starts_with(place) && line.find(words) != std::string::npos;
        });
    };
    INFO(fmt::format("{}", fmt::join(lines, "\n")));
    CHECK(has("7:7", "ear: expected a table, found a whole number"));
    CHECK(has("9:", "\"a b\" cannot be used in file names"));
    CHECK(has("12:", "the box reaches from 1 to 0 along x"));
    CHECK(has("14:1", "unknown key \"sphere\""));
    const auto empty = lines_of(with_object("mesh = \"v.obj\"\nareas = { rim = { } }"));
    REQUIRE(empty.size() == 1);
    CHECK_THAT(empty[0], Catch::StartsWith("6:11: nothing says where \"rim\" is"));
    const auto twice = lines_of(with_object("mesh = \"v.obj\"\nhead = { spheres = [[0, 0, 9, 2]] }\n"
                                            "areas = { head = { spheres = [[0, 0, 9, 2]] } }"));
    REQUIRE(twice.size() == 1);
    CHECK_THAT(twice[0], Catch::Contains("\"head\" is described twice"));
}

TEST_CASE("shares of simulated gaze are at most all, and the head's has its usual one where nothing is said",
          "[unit]") {
    Task task;
    CHECK(simulated_shares(task) == AreaShares{{"head", 0.4}});
    task.simulated_area_shares = {{"rim", 0.3}};
    CHECK(simulated_shares(task) == AreaShares{{"head", 0.0}, {"rim", 0.3}});
    task.simulated_head_share = 0.1;
    CHECK(simulated_shares(task) == AreaShares{{"head", 0.1}, {"rim", 0.3}});
    task.simulated_area_shares.emplace_back("head", 0.2);
    CHECK(simulated_shares(task) == AreaShares{{"head", 0.2}, {"rim", 0.3}});
    const auto shares = [&](std::string_view keys) {
        return lines_of(with_object("shipped = \"muse\"", keys));
    };
    CHECK(shares("simulated_area_shares = { body = 0.5, plinth = 0.5 }").empty());
    const auto too_much = shares("simulated_area_shares = { body = 0.5, plinth = 0.6 }");
    REQUIRE(too_much.size() == 1);
    CHECK_THAT(too_much[0], Catch::StartsWith("11:25: 1.1 of the fixations") || Catch::Contains("1.1 of"));
    CHECK(shares("simulated_area_shares = { body = 1.5 }").size() == 1);
    CHECK(shares("simulated_area_shares = 0.5").size() == 1);
    CHECK(shares("simulated_head_share = 0.2\nsimulated_area_shares = { head = 0.2 }").size() == 1);
}
