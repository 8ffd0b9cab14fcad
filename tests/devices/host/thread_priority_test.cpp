#include "devices/host/thread_priority.h"

#include <thread>

#include <catch2/catch.hpp>
#include <chrono>
#include <stdexcept>

#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>

#include "tests/support/skip.h"

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

TEST_CASE("a thread with real-time priority that does not sleep loses it, goes on, and has it again",
          "[unit]") {
    rlimit before{};
    getrlimit(RLIMIT_RTTIME, &before);
    bool was_granted = false;
    int while_busy = -1, afterwards = -1;
    std::optional<ThreadWish> regained, again;
    std::thread([&] {
        was_granted = prepare_thread({.realtime = true}).back().granted;
        if (!was_granted)
            return;
        // Busy for as long as it takes, and no longer than a kernel that takes nothing away would have us
        // wait.
        const auto begin = std::chrono::steady_clock::now();
        while ((while_busy = sched_getscheduler(0)) != SCHED_OTHER &&
               std::chrono::steady_clock::now() - begin < std::chrono::seconds(20)) {
        }
        regained = regain_realtime_priority();
        afterwards = sched_getscheduler(0) & ~SCHED_RESET_ON_FORK;
        again = regain_realtime_priority();
    }).join();
    setrlimit(RLIMIT_RTTIME, &before);
    munlockall();
    if (!was_granted)
        OVERT_SKIP("this machine gives no real-time priority");
    CHECK(while_busy == SCHED_OTHER);
    REQUIRE(regained);
    CHECK(regained->granted);
    CHECK(regained->detail.find("150 ms") != std::string::npos);
    CHECK(afterwards != SCHED_OTHER);
    CHECK_FALSE(again); // it is said once
}

TEST_CASE("work at normal priority is done on another thread, and its errors come back", "[unit]") {
    std::thread::id worker;
    at_normal_priority([&] { worker = std::this_thread::get_id(); });
    CHECK(worker != std::this_thread::get_id());
    CHECK_THROWS_AS(at_normal_priority([] { throw std::runtime_error("full disk"); }), std::runtime_error);
}
