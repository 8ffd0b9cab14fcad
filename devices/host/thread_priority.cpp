#include "devices/host/thread_priority.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <future>
#include <thread>

#include <fcntl.h>
#include <fmt/format.h>
#include <sched.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

namespace overt {

namespace {

/// Above what desktop audio takes, below the kernel's own interrupt threads (50).
constexpr int own_priority = 40;

/// RealtimeKit gives no more (its --max-realtime-priority).
constexpr int realtime_kit_priority = 20;

std::string error_text(int error) { return std::strerror(error); }

/// The thread that has real-time priority, by its number in the kernel; 0: none. Read in a signal's handler.
std::atomic<pid_t> realtime_thread = 0;
std::atomic<int> losses = 0;

/// The kernel sends SIGXCPU when a thread with real-time priority has not slept for the soft limit, and once
/// a second from then on; at the hard limit it kills.
void take_priority_away(int signal) {
    const int error = errno;
    const sched_param normal{0};
    if (const pid_t thread = realtime_thread.exchange(0))
        losses += sched_setscheduler(thread, SCHED_OTHER, &normal) == 0;
    else if (losses == 0) { // a limit on processor time that is none of ours
        std::signal(signal, SIG_DFL);
        std::raise(signal);
    }
    errno = error;
}

void guard_this_thread() {
    struct sigaction action {};
    action.sa_handler = take_priority_away;
    action.sa_flags = SA_RESTART;
    sigaction(SIGXCPU, &action, nullptr);
    realtime_thread = static_cast<pid_t>(syscall(SYS_gettid));
}

bool is_realtime() {
    const int policy = sched_getscheduler(0);
    return (policy & ~SCHED_RESET_ON_FORK) > SCHED_OTHER; // -1: not known
}

/// Asks RealtimeKit over the system's message bus, with systemd's own program for that. It wants a bound on
/// how long the thread may run without sleeping.
bool ask_realtime_kit() {
    rlimit busy{1000 * realtime_busy_limit_ms, 200'000}; // microseconds: its --rttime-usec-max
    if (setrlimit(RLIMIT_RTTIME, &busy) != 0)
        return false;
    const std::string process = std::to_string(getpid()), thread = std::to_string(syscall(SYS_gettid)),
                      priority = std::to_string(realtime_kit_priority);
    const char* const arguments[] = {"busctl",
                                     "call",
                                     "--timeout=2",
                                     "org.freedesktop.RealtimeKit1",
                                     "/org/freedesktop/RealtimeKit1",
                                     "org.freedesktop.RealtimeKit1",
                                     "MakeThreadRealtimeWithPID",
                                     "ttu",
                                     process.c_str(),
                                     thread.c_str(),
                                     priority.c_str(),
                                     nullptr};
    posix_spawn_file_actions_t silent;
    posix_spawn_file_actions_init(&silent);
    posix_spawn_file_actions_addopen(&silent, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&silent, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    pid_t child{};
    const int refused =
        posix_spawnp(&child, "busctl", &silent, nullptr, const_cast<char**>(arguments), environ);
    posix_spawn_file_actions_destroy(&silent);
    int status{};
    return refused == 0 && waitpid(child, &status, 0) == child && status == 0 && is_realtime();
}

ThreadWish take_priority() {
    ThreadWish wish{"real-time priority", false, {}};
    const sched_param priority{own_priority};
    guard_this_thread();
    if (sched_setscheduler(0, SCHED_FIFO | SCHED_RESET_ON_FORK, &priority) == 0) {
        rlimit busy{};
        getrlimit(RLIMIT_RTTIME, &busy);
        busy.rlim_cur = std::min<rlim_t>(1000 * realtime_busy_limit_ms, busy.rlim_max);
        setrlimit(RLIMIT_RTTIME, &busy);
        return {wish.what, true, fmt::format("SCHED_FIFO {}", own_priority)};
    }
    const int error = errno;
    if (ask_realtime_kit())
        return {wish.what, true, fmt::format("SCHED_RR {} through RealtimeKit", realtime_kit_priority)};
    wish.detail =
        fmt::format("{}; let this user have rtprio {} in /etc/security/limits.conf, or install rtkit",
                    error_text(error), own_priority);
    realtime_thread = 0;
    return wish;
}

ThreadWish lock_memory() {
    ThreadWish wish{"locked memory", false, {}};
    rlimit limit{};
    getrlimit(RLIMIT_MEMLOCK, &limit);
    // Under a limit, locking what is to come would make later requests for memory fail.
    const bool unlimited = limit.rlim_cur == RLIM_INFINITY || geteuid() == 0;
    if (mlockall(unlimited ? MCL_CURRENT | MCL_FUTURE : MCL_CURRENT) == 0)
        return {wish.what, true, unlimited ? "what there is and what comes" : "what there is"};
    wish.detail = fmt::format("{}; let this user have memlock unlimited in /etc/security/limits.conf",
                              error_text(errno));
    return wish;
}

ThreadWish stay_on(int processor) {
    ThreadWish wish{fmt::format("processor {}", processor), false, {}};
    cpu_set_t set;
    CPU_ZERO(&set);
    if (processor < 0 || processor >= CPU_SETSIZE) {
        wish.detail = "there is no such processor";
        return wish;
    }
    CPU_SET(static_cast<std::size_t>(processor), &set);
    if (sched_setaffinity(0, sizeof set, &set) == 0)
        return {wish.what, true, "this thread runs on it alone"};
    wish.detail =
        errno == EINVAL ? "there is no such processor, or this process may not use it" : error_text(errno);
    return wish;
}

} // namespace

ThreadWish try_realtime_priority() {
    ThreadWish wish;
    std::thread([&wish] { wish = take_priority(); }).join();
    realtime_thread = 0;
    return wish;
}

std::optional<ThreadWish> regain_realtime_priority() {
    const int lost = losses.exchange(0);
    if (lost == 0)
        return {};
    ThreadWish wish = take_priority();
    wish.detail = fmt::format(
        "was taken away from the session's thread, which had been busy for {} ms without a "
        "pause; {}{}",
        realtime_busy_limit_ms, wish.granted ? "taken again: " : "and is refused now: ", wish.detail);
    return wish;
}

void at_normal_priority(const std::function<void()>& work) {
    std::async(std::launch::async, [&work] {
        const sched_param normal{0};
        sched_setscheduler(0, SCHED_OTHER, &normal); // where RealtimeKit's threads are inherited after all
        work();
    }).get();
}

std::vector<ThreadWish> prepare_thread(const ThreadWishes& wishes) {
    std::vector<ThreadWish> answers;
    if (wishes.processor)
        answers.push_back(stay_on(*wishes.processor));
    if (wishes.realtime) {
        answers.push_back(lock_memory());
        answers.push_back(take_priority());
    }
    return answers;
}

} // namespace overt
