#include <catch2/catch.hpp>

#include <algorithm>
#include <cerrno>
#include <cstdarg>
#include <ctime>
#include <thread>
#include <utility>
#include <vector>

#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "devices/host/clocks.h"
#include "tests/support/next_function.h"

using namespace overt;
using namespace overt::test;
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

namespace {

/// The system's clocks as a test says, for one thread: each reading takes its time, and sleeping goes to the
/// instant that is slept to.
struct ClockStandIn {
    ClockStandIn() { now = this; }
    ~ClockStandIn() { now = nullptr; }
    ClockStandIn(const ClockStandIn&) = delete;
    ClockStandIn& operator=(const ClockStandIn&) = delete;

    std::chrono::nanoseconds monotonic{std::chrono::seconds(1000)}, slept{},
        wall{std::chrono::hours(500'000)}, reading{};
    std::vector<std::chrono::nanoseconds> sleeps; ///< to when, since the machine was started
    int interruptions = 0;
    std::vector<std::pair<int, unsigned long>> asked;
    static inline thread_local ClockStandIn* now = nullptr;
};

} // namespace

// They take the place of the C library's for this program.
extern "C" {
[[gnu::no_sanitize("thread")]] int clock_gettime(clockid_t clock, timespec* time) noexcept {
    static decltype(clock_gettime)* next; // without a guard, which would be watched
    if (!next)
        next = next_function<decltype(clock_gettime)>("clock_gettime");
    if (!ClockStandIn::now)
        return next(clock, time);
    ClockStandIn& standing = *ClockStandIn::now;
    standing.monotonic += standing.reading;
    const std::chrono::nanoseconds told = clock == CLOCK_MONOTONIC ? standing.monotonic
                                          : clock == CLOCK_BOOTTIME
                                              ? standing.monotonic + standing.slept
                                              : standing.monotonic + standing.slept + standing.wall;
    time->tv_sec = static_cast<time_t>(told.count() / 1'000'000'000);
    time->tv_nsec = static_cast<long>(told.count() % 1'000'000'000);
    return 0;
}
[[gnu::no_sanitize("thread")]] int clock_nanosleep(clockid_t clock, int flags, const timespec* time,
                                                   timespec* left) {
    static decltype(clock_nanosleep)* next; // without a guard, which would be watched
    if (!next)
        next = next_function<decltype(clock_nanosleep)>("clock_nanosleep");
    if (!ClockStandIn::now)
        return next(clock, flags, time, left);
    ClockStandIn& standing = *ClockStandIn::now;
    CHECK(clock == CLOCK_MONOTONIC);
    CHECK(flags == TIMER_ABSTIME);
    standing.sleeps.push_back(std::chrono::seconds(time->tv_sec) + std::chrono::nanoseconds(time->tv_nsec));
    if (standing.interruptions > 0) {
        --standing.interruptions;
        return EINTR;
    }
    standing.monotonic = std::max(standing.monotonic, standing.sleeps.back());
    return 0;
}
[[gnu::no_sanitize("thread")]] int prctl(int option, ...) noexcept {
    va_list rest;
    va_start(rest, option);
    const auto value = va_arg(rest, unsigned long);
    va_end(rest);
    if (!ClockStandIn::now)
        return static_cast<int>(syscall(SYS_prctl, option, value, 0ul, 0ul, 0ul));
    ClockStandIn::now->asked.emplace_back(option, value);
    return 0;
}
}

TEST_CASE("a steady clock wakes 300 us before an instant and then at it, whatever interrupts it", "[unit]") {
    std::thread([] {
        ClockStandIn system;
        SteadyClock clock(SessionTime(5s));
        using Sleeps = std::vector<std::chrono::nanoseconds>;
        const std::chrono::nanoseconds started = 1000s;
        CHECK(clock.now() == SessionTime(5s));
        clock.wait_until(SessionTime(5s + 2ms));
        CHECK(system.sleeps == Sleeps{started + 1700us, started + 2ms});
        CHECK(clock.now() == SessionTime(5s + 2ms));
        CHECK(system.asked == std::vector<std::pair<int, unsigned long>>{{PR_SET_TIMERSLACK, 1ul}});
        system.sleeps.clear();
        clock.wait_until(SessionTime(5s + 2300us)); // exactly so far away: once
        CHECK(system.sleeps == Sleeps{started + 2300us});
        system.sleeps.clear();
        clock.wait_until(SessionTime(5s + 2300us)); // now
        clock.wait_until(SessionTime(4s));
        CHECK(system.sleeps.empty());
        system.interruptions = 3;
        clock.wait_until(SessionTime(7s + 123456789ns));
        CHECK(system.sleeps == Sleeps{started + 2123156789ns, started + 2123156789ns, started + 2123156789ns,
                                      started + 2123156789ns, started + 2123456789ns});
        CHECK(system.asked.size() == 1); // once for each thread
    }).join();
}

TEST_CASE("sleep of the machine and moves of the wall clock are told apart, whatever reading takes",
          "[unit]") {
    for (const std::chrono::nanoseconds reading : {0ns, 1000ns}) {
        ClockStandIn system;
        system.reading = reading;
        SteadyClock clock;
        CHECK(clock.disturbance().slept == 0ns);
        CHECK(clock.disturbance().wall_moved == 0ns);
        system.slept += 7s;
        CHECK(clock.disturbance().slept == 7s);
        CHECK(clock.disturbance().wall_moved == 0ns);
        system.wall -= 3s;
        CHECK(clock.disturbance().slept == 7s);
        CHECK(clock.disturbance().wall_moved == -3s);
        // A reading that takes longer now than at the start changes nothing.
        system.reading += 500us;
        CHECK(clock.disturbance().slept == 7s);
        CHECK(clock.disturbance().wall_moved == -3s);
    }
}
