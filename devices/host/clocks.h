/// The two session clocks: a steady one, and a virtual one that stands still until its wait_until() is
/// called.
#pragma once

#include <atomic>
#include <chrono>

#include "experiment/ports/clock.h"

namespace overt {

/// Time since this was made, by CLOCK_MONOTONIC, plus what it starts with. Any thread may read it and wait on
/// it.
class SteadyClock final : public Clock {
  public:
    /// `start`: what it shows at first; a resumed session goes on from its last time.
    explicit SteadyClock(SessionTime start = {});

    SessionTime now() const noexcept override;

    /// Sleeps until about 0.3 ms before and then once more: the first waking brings the processor out of its
    /// deep sleep, the second is then punctual. Never spins. Takes the kernel's timer slack (50 us) off the
    /// calling thread.
    void wait_until(SessionTime time) noexcept override;

    /// By CLOCK_BOOTTIME, which goes on while the machine is suspended, and CLOCK_REALTIME, which can be set.
    Disturbance disturbance() const noexcept override;

  private:
    std::chrono::steady_clock::time_point origin_;
    Disturbance at_start_;
};

/// Moves only when it is waited on, and then jumps. Any thread may read it and wait on it.
class VirtualClock final : public Clock {
  public:
    explicit VirtualClock(SessionTime start = {}) : nanoseconds_(start.time_since_epoch().count()) {}

    SessionTime now() const noexcept override;

    /// Moves the clock to `time`, never back.
    void wait_until(SessionTime time) noexcept override;

  private:
    std::atomic<SessionClock::rep> nanoseconds_;
    static_assert(std::atomic<SessionClock::rep>::is_always_lock_free);
};

} // namespace overt
