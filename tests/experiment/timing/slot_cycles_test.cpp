#include "experiment/timing/slot_cycles.h"

#include <catch2/catch.hpp>

using namespace overt;

namespace {

/// Two frames of two refreshes each, then another of `last` refreshes.
PageCycle cycle_of(std::vector<int> frames, int held, int total) {
    PageCycle cycle;
    for (const int frame : frames) {
        cycle.entries.push_back({{frame}, {10 + frame}, held});
        for (int i = 0; i < held; ++i)
            cycle.entry_of_refresh.push_back(static_cast<std::uint16_t>(cycle.entries.size() - 1));
    }
    cycle.total_refreshes = total;
    return cycle;
}

} // namespace

TEST_CASE("a trial without further slots shows its first stimulus alone", "[unit]") {
    SlotCycles slots;
    slots.begin(3, 1, {0}, {});
    REQUIRE(slots.frames({5}, 0).size() == 1);
    CHECK(slots.frames({5}, 0)[0] == AnimationFrameIndex{5});
    CHECK(slots.enter({}, 0).empty());
}

TEST_CASE("further slots follow the ledger's refreshes, each through its own cycle", "[unit]") {
    SlotCycles slots;
    // The second ends before the ledger's plan of eight refreshes, and begins again.
    slots.begin(3, 3, {0, 1, 2}, {cycle_of({0, 1, 2, 3}, 2, 8), cycle_of({7, 9}, 1, 4)});
    const int first[] = {0, 0, 1, 1, 2, 2, 3, 3}, second[] = {7, 9, 7, 9, 7, 9, 7, 9};
    for (int refresh = 0; refresh < 8; ++refresh) {
        CAPTURE(refresh);
        const auto frames = slots.frames({40 + refresh}, refresh);
        REQUIRE(frames.size() == 3);
        CHECK(frames[0].value == 40 + refresh);
        CHECK(frames[1].value == first[refresh]);
        CHECK(frames[2].value == second[refresh]);
        FlipRecord flip;
        flip.refresh_in_trial = refresh;
        const auto rows = slots.enter(flip, refresh);
        REQUIRE(rows.size() == 2);
        CHECK(rows[0] == SlotFlip{3, refresh, 1, {first[refresh]}, {first[refresh]}, {10 + first[refresh]}});
        CHECK(rows[1] ==
              SlotFlip{3, refresh, 2, {second[refresh]}, {second[refresh]}, {10 + second[refresh]}});
    }
}

TEST_CASE("a show lights some of a trial's slots, and the others stay empty", "[unit]") {
    SlotCycles slots;
    slots.begin(7, 4, {1, 3}, {cycle_of({5, 6}, 1, 2)});
    const auto frames = slots.frames({20}, 1);
    REQUIRE(frames.size() == 4);
    CHECK(frames[0] == no_frame);
    CHECK(frames[1].value == 20);
    CHECK(frames[2] == no_frame);
    CHECK(frames[3].value == 6);
    FlipRecord flip;
    flip.refresh_in_trial = 81; // of the attempt; the show's is 1
    flip.planned = flip.shown = {20};
    flip.pose = {9};
    const auto rows = slots.enter(flip, 1);
    REQUIRE(rows.size() == 2);
    CHECK(rows[0] == SlotFlip{7, 81, 1, {20}, {20}, {9}});
    CHECK(rows[1] == SlotFlip{7, 81, 3, {6}, {6}, {16}});
    CHECK(slots.of_first(flip).shown == no_frame);
    CHECK(slots.of_first(flip).refresh_in_trial == 81);
    slots.begin(7, 4, {0}, {});
    CHECK(slots.of_first(flip).shown.value == 20);
    CHECK(slots.frames({2}, 0)[1] == no_frame);
}

TEST_CASE("what a slot shows late stands beside what was planned for that refresh", "[unit]") {
    SlotCycles slots;
    slots.begin(0, 2, {0, 1}, {cycle_of({0, 1, 2, 3}, 1, 4)});
    slots.frames({0}, 1); // meant for refresh 1
    FlipRecord flip;
    flip.refresh_in_trial = 3; // lit two later
    CHECK(slots.enter(flip, 3)[0] == SlotFlip{0, 3, 1, {3}, {1}, {11}});
    // After the plan's end nothing is planned.
    slots.frames({0}, 3);
    flip.refresh_in_trial = 5;
    flip.planned = no_frame;
    CHECK(slots.enter(flip, 5)[0] == SlotFlip{0, 5, 1, no_frame, {3}, {13}});
}
