/// Runs independent work on all processors.
#pragma once

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace overt {

/// Calls work(i) for each i in 0 … count-1, on as many threads as the machine has processors, and returns
/// when all are done. Which thread takes which i is open, so work(i) must depend on i alone. The first
/// exception thrown ends the work early and is thrown again here. `most_threads` sets a lower limit; 0 sets
/// none.
template <class Work> void parallel_for(int count, const Work& work, int most_threads = 0) {
    const int processors = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
    const int threads = std::min(count, most_threads > 0 ? std::min(most_threads, processors) : processors);
    std::atomic<int> next{0};
    std::exception_ptr failure;
    std::mutex failure_mutex;
    const auto take_turns = [&] {
        for (int i = next++; i < count; i = next++) {
            try {
                work(i);
            } catch (...) {
                const std::scoped_lock lock(failure_mutex);
                if (!failure)
                    failure = std::current_exception();
                next = count;
            }
        }
    };
    {
        std::vector<std::jthread> helpers;
        for (int i = 1; i < threads; ++i)
            helpers.emplace_back(take_turns);
        take_turns();
    }
    if (failure)
        std::rethrow_exception(failure);
}

} // namespace overt
