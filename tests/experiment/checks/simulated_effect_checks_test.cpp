#include <catch2/catch.hpp>

#include "tests/experiment/protocol/protocol_fixtures.h"

using namespace overt;
using namespace overt::test;

namespace {

std::vector<std::string> findings(std::string_view effects) {
    return ReadText(minimal_protocol, effects).lines();
}

} // namespace

TEST_CASE("simulated effects name what there is, and spots share out no more than all fixations", "[unit]") {
    CHECK(findings("[[simulated_effect]]\nmaterial = \"gold\"\nhead_odds = 2\nspot_share = 0.6\n"
                   "[[simulated_effect]]\ntask = \"free\"\nspot_share = 0.4\n")
              .empty());
    const auto unknown =
        findings("[[simulated_effect]]\ntask = \"fre\"\n[[simulated_effect]]\nobject = \"b\"\n"
                 "[[simulated_effect]]\nmaterial = \"silver\"\n");
    REQUIRE(unknown.size() == 3);
    CHECK_THAT(unknown[0], Catch::StartsWith("13:8: there is no task \"fre\""));
    CHECK_THAT(unknown[1], Catch::StartsWith("15:13: there is no object \"b\""));
    CHECK_THAT(unknown[2], Catch::StartsWith("17:12: there is no material \"silver\""));
    const auto too_much = findings("[[simulated_effect]]\nmaterial = \"gold\"\nspot_share = 0.6\n"
                                   "[[simulated_effect]]\ntask = \"free\"\nspot_share = 0.5\n");
    REQUIRE(too_much.size() == 2);
    CHECK_THAT(too_much[0], Catch::StartsWith("14:14: ") && Catch::Contains("1.1"));
    // The odds of one area each.
    const auto odds = findings("[[simulated_effect]]\narea = \"rim\"\nhead_odds = 2\n"
                               "[[simulated_effect]]\narea_odds = 2\n");
    REQUIRE(odds.size() == 2);
    CHECK_THAT(odds[0], Catch::StartsWith("14:13: one effect has the odds of one area"));
    CHECK_THAT(odds[1], Catch::StartsWith("16:13: \"area_odds\" without \"area\""));
    std::string many;
    for (int i = 0; i < 9; ++i)
        many += "[[simulated_effect]]\nspot_share = 0.1\n";
    const auto crowded = findings(many);
    REQUIRE(crowded.size() == 1);
    CHECK_THAT(crowded[0], Catch::Contains("9 effects have a spot"));
}
