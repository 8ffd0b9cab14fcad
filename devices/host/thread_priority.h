/// Keeps the session's thread from waiting for others: priority, memory that stays in memory, a processor of
/// its own. What the system refuses is said, and nothing fails.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace overt {

struct ThreadWishes {
    bool realtime = false;             ///< SCHED_FIFO, and all memory locked
    std::optional<int> processor = {}; ///< the only one to run on
};

/// One wish, and what became of it, in words.
struct ThreadWish {
    std::string what;
    bool granted = false;
    std::string detail; ///< how, or why not and what would help
};

/// For so long a thread with real-time priority may be busy without sleeping. Below the 200 ms after which
/// RealtimeKit has the kernel kill the process (its --rttime-usec-max).
inline constexpr int realtime_busy_limit_ms = 150;

/// Gives the calling thread what it wishes, as far as the system lets it. Priority comes from the kernel, or
/// from RealtimeKit where only that may give it. Threads made later do not inherit it. To be called once
/// everything is loaded, for locked memory is all that the process has. Allocates, and may run a program.
///
/// Priority can do no harm: a thread that is busy for `realtime_busy_limit_ms` loses it by the signal
/// SIGXCPU, and goes on as any other (setrlimit(2), RLIMIT_RTTIME). One thread of the process can have it so.
std::vector<ThreadWish> prepare_thread(const ThreadWishes& wishes);

/// If the calling thread has lost its real-time priority in that way, asks for it again and says what became
/// of it. To be called where time is not short, on the thread that prepare_thread was called on.
std::optional<ThreadWish> regain_realtime_priority();

/// Does the work on a thread of its own, at normal priority, and waits for it. Throws what the work throws.
void at_normal_priority(const std::function<void()>& work);

/// Whether a thread would be given real-time priority: tried with one of its own, that ends at once.
ThreadWish try_realtime_priority();

} // namespace overt
