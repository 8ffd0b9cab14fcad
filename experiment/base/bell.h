/// Wakes a thread from another that must never wait.
#pragma once

#include <atomic>
#include <cerrno>
#include <chrono>
#include <ctime>

#include <semaphore.h>

#include "experiment/base/error.h"

namespace overt {

/// One thread sleeps, any thread rings; ringing neither blocks nor allocates.
class Bell {
  public:
    Bell() { OVERT_EXPECTS(::sem_init(&semaphore_, 0, 0) == 0); }
    ~Bell() { ::sem_destroy(&semaphore_); }
    Bell(const Bell&) = delete;
    Bell& operator=(const Bell&) = delete;

    void ring() noexcept {
        if (!ringing_.exchange(true, std::memory_order_acq_rel))
            ::sem_post(&semaphore_);
    }
    /// Returns when it rings, or after the time.
    void wait_for(std::chrono::milliseconds time) noexcept {
        timespec until{};
        ::clock_gettime(CLOCK_MONOTONIC, &until);
        const auto nanoseconds = until.tv_nsec + std::chrono::nanoseconds(time).count();
        until.tv_sec += nanoseconds / 1'000'000'000;
        until.tv_nsec = nanoseconds % 1'000'000'000;
        while (::sem_clockwait(&semaphore_, CLOCK_MONOTONIC, &until) != 0 && errno == EINTR) {
        }
        ringing_.store(false, std::memory_order_release);
    }

  private:
    ::sem_t semaphore_;
    std::atomic<bool> ringing_{false};
};

} // namespace overt
