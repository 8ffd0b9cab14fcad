/// The clocks that benchmarks read, in seconds.
#pragma once

#include <chrono>
#include <ctime>

namespace overt {

inline double seconds_of(clockid_t clock) {
    timespec time{};
    clock_gettime(clock, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Processor time of all threads of this process: on a machine with other work to do it says more than the
/// clock on the wall.
inline double processor_seconds() { return seconds_of(CLOCK_PROCESS_CPUTIME_ID); }

/// Processor time of this thread: what other threads and programs take of the machine does not count.
inline double thread_seconds() { return seconds_of(CLOCK_THREAD_CPUTIME_ID); }

inline double seconds_since(std::chrono::steady_clock::time_point begin) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// By the clock on the wall.
template <class Work> double seconds_for(const Work& work) {
    const auto begin = std::chrono::steady_clock::now();
    work();
    return seconds_since(begin);
}

} // namespace overt
