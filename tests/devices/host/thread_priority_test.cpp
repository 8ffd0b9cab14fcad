#include "devices/host/thread_priority.h"

#include <cerrno>
#include <thread>

#include <catch2/catch.hpp>
#include <chrono>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <sched.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/support/next_function.h"
#include "tests/support/skip.h"

using namespace overt;
using namespace overt::test;

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

namespace {

/// A system of the test's own, which gives or refuses what a thread asks for, and changes nothing.
struct HostStandIn {
    HostStandIn() { now = this; }
    ~HostStandIn() { now = nullptr; }
    HostStandIn(const HostStandIn&) = delete;
    HostStandIn& operator=(const HostStandIn&) = delete;
    int note(std::string words, int error) {
        asked.push_back(std::move(words));
        errno = error;
        return error == 0 ? 0 : -1;
    }
    std::vector<std::string> taken() { return std::exchange(asked, {}); }

    int scheduler_error = 0, limit_error = 0, memory_error = 0, processor_error = 0;
    int spawn_error = 0, child_status = 0, policy = SCHED_RR;
    pid_t waits_for = 4321;
    uid_t user = 1000;
    rlim_t locked = 65536, busy = RLIM_INFINITY;
    std::vector<std::string> asked;
    int other_threads = 0; ///< that were meant, and not the one that asks
    static inline HostStandIn* now = nullptr;
};

const std::string wishes_fifo =
    fmt::format("scheduler {} 40", static_cast<int>(SCHED_FIFO | SCHED_RESET_ON_FORK));

} // namespace

// They take the place of the C library's for this program.
extern "C" {
[[gnu::no_sanitize("thread")]] int sched_setscheduler(pid_t thread, int policy,
                                                      const sched_param* param) noexcept {
    if (!HostStandIn::now)
        return next_function<decltype(sched_setscheduler)>("sched_setscheduler")(thread, policy, param);
    HostStandIn::now->other_threads += thread != 0;
    return HostStandIn::now->note(fmt::format("scheduler {} {}", policy, param->sched_priority),
                                  HostStandIn::now->scheduler_error);
}
[[gnu::no_sanitize("thread")]] int sched_getscheduler(pid_t thread) noexcept {
    if (HostStandIn::now)
        HostStandIn::now->other_threads += thread != 0;
    return HostStandIn::now ? HostStandIn::now->policy
                            : next_function<decltype(sched_getscheduler)>("sched_getscheduler")(thread);
}
[[gnu::no_sanitize("thread")]] int sched_setaffinity(pid_t thread, std::size_t size,
                                                     const cpu_set_t* set) noexcept {
    if (!HostStandIn::now)
        return next_function<decltype(sched_setaffinity)>("sched_setaffinity")(thread, size, set);
    HostStandIn::now->other_threads += thread != 0;
    std::string processors = "processors";
    for (std::size_t i = 0; i < CPU_SETSIZE; ++i)
        if (CPU_ISSET(i, set))
            processors += fmt::format(" {}", i);
    return HostStandIn::now->note(processors, HostStandIn::now->processor_error);
}
[[gnu::no_sanitize("thread")]] int setrlimit(int resource, const rlimit* limit) noexcept {
    if (!HostStandIn::now)
        return next_function<decltype(setrlimit)>("setrlimit")(resource, limit);
    return HostStandIn::now->note(fmt::format("{} {} {}",
                                              resource == RLIMIT_RTTIME ? "busy" : "another limit",
                                              limit->rlim_cur, limit->rlim_max),
                                  HostStandIn::now->limit_error);
}
[[gnu::no_sanitize("thread")]] int getrlimit(int resource, rlimit* limit) noexcept {
    if (!HostStandIn::now)
        return next_function<decltype(getrlimit)>("getrlimit")(resource, limit);
    *limit = resource == RLIMIT_RTTIME    ? rlimit{RLIM_INFINITY, HostStandIn::now->busy}
             : resource == RLIMIT_MEMLOCK ? rlimit{HostStandIn::now->locked, RLIM_INFINITY}
                                          : rlimit{};
    return 0;
}
[[gnu::no_sanitize("thread")]] int mlockall(int flags) noexcept {
    if (!HostStandIn::now)
        return next_function<decltype(mlockall)>("mlockall")(flags);
    return HostStandIn::now->note(fmt::format("lock{}{}", (flags & MCL_CURRENT) != 0 ? " now" : "",
                                              (flags & MCL_FUTURE) != 0 ? " later" : ""),
                                  HostStandIn::now->memory_error);
}
[[gnu::no_sanitize("thread")]] uid_t geteuid() noexcept {
    return HostStandIn::now ? HostStandIn::now->user : static_cast<uid_t>(syscall(SYS_geteuid));
}
int posix_spawnp(pid_t* child, const char* file, const posix_spawn_file_actions_t* actions,
                 const posix_spawnattr_t* attributes, char* const* arguments, char* const* variables) {
    if (!HostStandIn::now)
        return next_function<decltype(posix_spawnp)>("posix_spawnp")(child, file, actions, attributes,
                                                                     arguments, variables);
    std::string words =
        std::string("run ") + file + (actions && variables ? ":" : " and shows what it says:");
    for (; *arguments; ++arguments)
        words += std::string(" ") + *arguments;
    HostStandIn::now->note(words, 0);
    *child = 4321;
    return HostStandIn::now->spawn_error;
}
pid_t waitpid(pid_t child, int* status, int options) {
    if (!HostStandIn::now)
        return next_function<decltype(waitpid)>("waitpid")(child, status, options);
    HostStandIn::now->note(fmt::format("wait {} {}", child, options), 0);
    *status = HostStandIn::now->child_status;
    return HostStandIn::now->waits_for;
}
}

TEST_CASE("real-time priority is asked of the kernel, with a limit on how long a thread may be busy",
          "[unit]") {
    HostStandIn host;
    auto answers = prepare_thread({.realtime = true});
    REQUIRE(answers.size() == 2);
    CHECK(answers[0].what == "locked memory");
    CHECK(answers[0].granted);
    CHECK(answers[0].detail == "what there is"); // more would fail later, where it is limited
    CHECK(answers[1].what == "real-time priority");
    CHECK(answers[1].granted);
    CHECK(answers[1].detail == "SCHED_FIFO 40");
    CHECK(host.taken() ==
          std::vector<std::string>{"lock now", wishes_fifo, fmt::format("busy 150000 {}", RLIM_INFINITY)});
    host.busy = 70'000;
    host.user = 0;
    answers = prepare_thread({.realtime = true});
    CHECK(answers[0].detail == "what there is and what comes");
    CHECK(host.taken() == std::vector<std::string>{"lock now later", wishes_fifo, "busy 70000 70000"});
    host.user = 1000;
    host.locked = RLIM_INFINITY;
    host.memory_error = ENOMEM;
    answers = prepare_thread({.realtime = true});
    CHECK_FALSE(answers[0].granted);
    CHECK(answers[0].detail ==
          "Cannot allocate memory; let this user have memlock unlimited in /etc/security/limits.conf");
    CHECK(host.taken().front() == "lock now later");
    answers = prepare_thread({.realtime = false, .processor = 3});
    REQUIRE(answers.size() == 1);
    CHECK(answers[0].what == "processor 3");
    CHECK(answers[0].granted);
    CHECK(host.taken() == std::vector<std::string>{"processors 3"});
    for (const auto& [error, words] :
         {std::pair(EINVAL, "there is no such processor, or this process may not use it"),
          {EPERM, "Operation not permitted"}}) {
        host.processor_error = error;
        answers = prepare_thread({.realtime = false, .processor = 3});
        CHECK_FALSE(answers[0].granted);
        CHECK(answers[0].detail == words);
    }
    host.taken();
    for (const int none : {-1, CPU_SETSIZE}) {
        answers = prepare_thread({.realtime = false, .processor = none});
        CHECK_FALSE(answers[0].granted);
        CHECK(answers[0].detail == "there is no such processor");
    }
    CHECK(host.taken().empty());
    // In a thread of its own, which ends with it.
    CHECK(try_realtime_priority().granted);
    CHECK(host.taken().front() == wishes_fifo);
    CHECK_FALSE(regain_realtime_priority()); // none was lost
    CHECK(host.taken().empty());
    at_normal_priority([] {});
    CHECK(host.taken() == std::vector<std::string>{fmt::format("scheduler {} 0", SCHED_OTHER)});
}

TEST_CASE("where the kernel refuses real-time priority RealtimeKit is asked, and believed where it is there",
          "[unit]") {
    HostStandIn host;
    host.scheduler_error = EPERM;
    const auto asked = [&] {
        const ThreadWish wish = prepare_thread({.realtime = true}).back();
        CHECK(wish.what == "real-time priority");
        if (!wish.granted)
            CHECK(wish.detail == "Operation not permitted; let this user have rtprio 40 in "
                                 "/etc/security/limits.conf, or install rtkit");
        else
            CHECK(wish.detail == "SCHED_RR 20 through RealtimeKit");
        return wish.granted;
    };
    const auto count = [](const std::vector<std::string>& all) { return all.size(); };
    CHECK(asked());
    CHECK(host.taken() == std::vector<std::string>{
                              "lock now", wishes_fifo, "busy 150000 200000",
                              fmt::format("run busctl: busctl call --timeout=2 org.freedesktop.RealtimeKit1 "
                                          "/org/freedesktop/RealtimeKit1 org.freedesktop.RealtimeKit1 "
                                          "MakeThreadRealtimeWithPID ttu {} {} 20",
                                          ::getpid(), syscall(SYS_gettid)),
                              "wait 4321 0"});
    host.policy = SCHED_FIFO | SCHED_RESET_ON_FORK;
    CHECK(asked());
    host.taken();
    for (const int none : {SCHED_OTHER, SCHED_OTHER | SCHED_RESET_ON_FORK, -1}) {
        host.policy = none;
        CHECK_FALSE(asked());
        CHECK(count(host.taken()) == 5);
    }
    host.policy = SCHED_RR;
    host.child_status = 256; // it failed
    CHECK_FALSE(asked());
    host.child_status = 0;
    host.waits_for = -1;
    CHECK_FALSE(asked());
    host.waits_for = 4321;
    host.taken();
    host.spawn_error = ENOENT; // there is no such program
    CHECK_FALSE(asked());
    CHECK(count(host.taken()) == 4);
    host.spawn_error = 0;
    host.limit_error = EPERM; // without a limit it gives none
    CHECK_FALSE(asked());
    CHECK(count(host.taken()) == 3);
}

TEST_CASE("all is asked for the thread that asks", "[unit]") {
    HostStandIn host;
    prepare_thread({.realtime = true, .processor = 1});
    try_realtime_priority();
    at_normal_priority([] {});
    host.scheduler_error = EPERM;
    prepare_thread({.realtime = true});
    CHECK(host.other_threads == 0);
}
