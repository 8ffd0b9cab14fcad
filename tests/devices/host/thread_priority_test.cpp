#include "devices/host/thread_priority.h"

#include <thread>

#include <catch2/catch.hpp>
#include <sched.h>

using namespace overt;

TEST_CASE("a thread that wishes for nothing is left as it is", "[unit]") {
    CHECK(prepare_thread({}).empty());
}

TEST_CASE("a thread on one processor runs there; one that is not there is refused in words", "[unit]") {
    std::vector<ThreadWish> there, not_there;
    int processor = -1, runs_on = -2;
    // In a thread of its own, for the test's is to stay as it is.
    std::thread([&] {
        processor = sched_getcpu();
        there = prepare_thread({false, processor});
        runs_on = sched_getcpu();
        not_there = prepare_thread({false, 1000});
    }).join();
    REQUIRE(there.size() == 1);
    CHECK(there[0].granted);
    CHECK(runs_on == processor);
    REQUIRE(not_there.size() == 1);
    CHECK_FALSE(not_there[0].granted);
    CHECK(not_there[0].what == "processor 1000");
    CHECK_FALSE(not_there[0].detail.empty());
}
