/// Keeps the session's thread from waiting for others: priority, memory that stays in memory, a processor of
/// its own. What the system refuses is said, and nothing fails.
#pragma once

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

/// Gives the calling thread what it wishes, as far as the system lets it. Priority comes from the kernel, or
/// from RealtimeKit where only that may give it. Threads made later do not inherit it. To be called once
/// everything is loaded, for locked memory is all that the process has. Allocates, and may run a program.
std::vector<ThreadWish> prepare_thread(const ThreadWishes& wishes);

/// Whether a thread would be given real-time priority: tried with one of its own, that ends at once.
ThreadWish try_realtime_priority();

} // namespace overt
