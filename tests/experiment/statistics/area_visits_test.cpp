/// Visits, dwell, first arrival and transitions of a way of gaze that is written out.
#include <catch2/catch.hpp>

#include "experiment/statistics/area_visits.h"

using namespace overt;

TEST_CASE("visits, dwell and first arrival are those of a way of gaze that was written out", "[unit]") {
    // 0, 0, 1, none, 1, 0 and 1 at once, 1.
    const std::vector<AreaLook> looks{{0.1, 0.2, {0}}, {0.35, 0.1, {0}},   {0.5, 0.25, {1}}, {0.8, 0.1, {}},
                                      {1.0, 0.3, {1}}, {1.4, 0.1, {0, 1}}, {1.6, 0.4, {1}}};
    const std::vector<AreaVisits> visits = area_visits(looks, 3);
    CHECK(visits[0].fixations == 3);
    CHECK(visits[0].visits == 2);
    CHECK(visits[0].dwell_s == Approx(0.4));
    CHECK(visits[0].visits_s == Approx(0.35 + 0.1));
    CHECK(visits[0].first_arrival_s == 0.1);
    CHECK(*visits[0].first_visit_s == Approx(0.3));
    CHECK(visits[1].fixations == 4);
    CHECK(visits[1].visits == 2);
    CHECK(visits[1].dwell_s == Approx(0.25 + 0.3 + 0.1 + 0.4));
    CHECK(visits[1].visits_s == Approx(0.25 + 1.0));
    CHECK(visits[1].first_arrival_s == 0.5);
    CHECK(*visits[1].first_visit_s == Approx(0.25));
    CHECK(visits[2].fixations == 0);
    CHECK(visits[2].visits == 0);
    CHECK_FALSE(visits[2].first_arrival_s.has_value());
    CHECK_FALSE(visits[2].first_visit_s.has_value());

    // From 0 to 1 once. From 1 into both at once is no way to another area, nor is what goes over no area.
    const std::vector<int> ways = area_transitions(looks, 3);
    CHECK(ways == std::vector<int>{0, 1, 0, 0, 0, 0, 0, 0, 0});
}

TEST_CASE("areas that share no place have as many transitions as changes of the area", "[unit]") {
    std::vector<AreaLook> looks;
    const std::vector<std::size_t> way{0, 1, 1, 2, 0, 2, 2, 1, 0, 0, 1};
    for (std::size_t i = 0; i < way.size(); ++i)
        looks.push_back({static_cast<double>(i), 1.0, {way[i]}});
    const std::vector<int> ways = area_transitions(looks, 3);
    CHECK(ways == std::vector<int>{0, 2, 1, 1, 0, 1, 1, 1, 0});
    int visits = 0;
    double dwell_s = 0.0;
    for (const AreaVisits& of : area_visits(looks, 3)) {
        visits += of.visits;
        dwell_s += of.dwell_s;
        CHECK(of.visits_s == of.dwell_s);
    }
    CHECK(visits == 8);
    CHECK(dwell_s == static_cast<double>(way.size()));
    CHECK(area_transitions({}, 2) == std::vector<int>(4, 0));
}
