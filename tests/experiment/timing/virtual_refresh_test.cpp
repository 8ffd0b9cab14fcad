#include "experiment/timing/virtual_refresh.h"

#include <catch2/catch.hpp>

#include "tests/experiment/record/plain_session.h"

using namespace overt;

namespace {

Trial trial_number(int index) {
    Trial trial;
    trial.index = index;
    return trial;
}

/// How many refreshes went by before each flip of a presentation after its onset.
std::vector<int> misses_of(VirtualRefresh& display, int trial, int flips) {
    display.next(); // a blank screen
    display.presentation_begins(trial_number(trial), 0);
    std::vector<int> misses;
    std::int64_t last = display.next().refresh.value;
    for (int i = 1; i < flips; ++i) {
        const std::int64_t refresh = display.next().refresh.value;
        misses.push_back(static_cast<int>(refresh - last - 1));
        last = refresh;
    }
    return misses;
}

} // namespace

TEST_CASE("a display that presents again starts from its plan of faults, not from where it left off",
          "[unit]") {
    test::StandingClock clock;
    DisplayFaults faults;
    DisplayFault skip{DisplayFault::Kind::skip};
    skip.refresh = 3;
    skip.refreshes = 2;
    faults.given = {skip};
    skip.trial = 1;
    skip.refresh = 8;
    faults.given.push_back(skip);
    VirtualRefresh display(clock, 100.0, faults);
    const std::vector<int> first{0, 0, 2, 0, 0, 0, 0}, second{0, 0, 2, 0, 0, 2, 0};
    CHECK(misses_of(display, 0, 8) == first);
    REQUIRE(display.struck().size() == 1);
    CHECK(display.struck().front().refresh == 3);
    CHECK(misses_of(display, 1, 8) == second);
    CHECK(display.struck().size() == 2);
    CHECK(misses_of(display, 2, 8) == first);
    CHECK(display.struck().size() == 1);
}

TEST_CASE("faults strike no screens between presentations", "[unit]") {
    test::StandingClock clock;
    DisplayFaults faults;
    DisplayFault skip{DisplayFault::Kind::skip};
    skip.refresh = 6; // the presentation ends before it
    faults.given = {skip};
    VirtualRefresh display(clock, 100.0, faults);
    misses_of(display, 0, 4);
    display.screen_shown({}, clock.now());
    const std::int64_t last = display.next().refresh.value;
    for (int i = 1; i <= 5; ++i)
        CHECK(display.next().refresh.value == last + i);
}
