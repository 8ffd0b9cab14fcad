#include <catch2/catch.hpp>

#include <algorithm>
#include <thread>
#include <vector>

#include "devices/host/clocks.h"

using namespace overt;
using namespace std::chrono_literals;

TEST_CASE("a virtual clock stands still until somebody waits", "[unit]") {
    VirtualClock clock;
    const SessionTime start = clock.now();
    CHECK(to_seconds(start) == 0.0);
    CHECK(clock.now() == start);
    clock.wait_until(start + 3s);
    CHECK(clock.now() == start + 3s);
    clock.wait_until(start + 1s);
    CHECK(clock.now() == start + 3s);
}

TEST_CASE("a virtual clock waited on by several threads ends at the latest of their times", "[unit]") {
    VirtualClock clock;
    std::vector<std::jthread> threads;
    for (int i = 0; i < 4; ++i) {
        threads.emplace_back([&clock, i] {
            for (int step = 0; step < 1000; ++step)
                clock.wait_until(SessionTime(std::chrono::microseconds(4 * step + i)));
        });
    }
    threads.clear();
    CHECK(clock.now() == SessionTime(3999us));
}

TEST_CASE("a steady clock never returns from a wait too early and never goes back", "[unit]") {
    SteadyClock clock;
    SessionTime last = clock.now();
    for (const SessionDuration wait : {SessionDuration(50us), SessionDuration(700us), SessionDuration(4ms)}) {
        const SessionTime until = clock.now() + wait;
        clock.wait_until(until);
        CHECK(clock.now() >= until);
        CHECK(clock.now() >= last);
        last = clock.now();
    }
    clock.wait_until(last - 1s); // past: returns at once
    CHECK(clock.now() >= last);
}
