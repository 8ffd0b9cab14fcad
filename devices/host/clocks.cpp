#include "devices/host/clocks.h"

#include <cerrno>
#include <ctime>

#include <sys/prctl.h>

namespace overt {

namespace {

constexpr SessionDuration early_waking = std::chrono::microseconds(300);

/// steady_clock counts CLOCK_MONOTONIC (libstdc++), so its time points are absolute times for the kernel.
void sleep_until(std::chrono::steady_clock::time_point time) noexcept {
    const auto since_boot = std::chrono::duration_cast<std::chrono::nanoseconds>(time.time_since_epoch());
    const timespec until{static_cast<time_t>(since_boot.count() / 1'000'000'000),
                         static_cast<long>(since_boot.count() % 1'000'000'000)};
    while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR) {
    }
}

SessionDuration reading_of(clockid_t clock) noexcept {
    timespec now{};
    clock_gettime(clock, &now);
    return std::chrono::seconds(now.tv_sec) + std::chrono::nanoseconds(now.tv_nsec);
}

/// By how much the boot clock is ahead of the monotonic one, and the wall clock of the boot clock. The middle
/// of two readings, so that reading one after the other makes no difference.
Clock::Disturbance others_ahead() noexcept {
    const SessionDuration monotonic = reading_of(CLOCK_MONOTONIC), boot = reading_of(CLOCK_BOOTTIME),
                          wall = reading_of(CLOCK_REALTIME), boot_again = reading_of(CLOCK_BOOTTIME),
                          monotonic_again = reading_of(CLOCK_MONOTONIC);
    const SessionDuration boot_mean = boot + (boot_again - boot) / 2;
    return {boot_mean - (monotonic + (monotonic_again - monotonic) / 2), wall - boot_mean};
}

} // namespace

SteadyClock::SteadyClock(SessionTime start)
    : origin_(std::chrono::steady_clock::now() - start.time_since_epoch()), at_start_(others_ahead()) {}

Clock::Disturbance SteadyClock::disturbance() const noexcept {
    const Disturbance now = others_ahead();
    return {now.slept - at_start_.slept, now.wall_moved - at_start_.wall_moved};
}

SessionTime SteadyClock::now() const noexcept {
    return SessionTime(
        std::chrono::duration_cast<SessionDuration>(std::chrono::steady_clock::now() - origin_));
}

void SteadyClock::wait_until(SessionTime time) noexcept {
    thread_local const bool punctual = prctl(PR_SET_TIMERSLACK, 1ul) == 0;
    static_cast<void>(punctual);
    const SessionDuration left = time - now();
    if (left <= SessionDuration::zero())
        return;
    const auto end = origin_ + time.time_since_epoch();
    if (left > early_waking)
        sleep_until(end - early_waking);
    sleep_until(end);
}

SessionTime VirtualClock::now() const noexcept {
    return SessionTime(SessionDuration(nanoseconds_.load(std::memory_order_acquire)));
}

void VirtualClock::wait_until(SessionTime time) noexcept {
    const SessionClock::rep target = time.time_since_epoch().count();
    SessionClock::rep current = nanoseconds_.load(std::memory_order_relaxed);
    while (current < target &&
           !nanoseconds_.compare_exchange_weak(current, target, std::memory_order_acq_rel)) {
    }
}

} // namespace overt
