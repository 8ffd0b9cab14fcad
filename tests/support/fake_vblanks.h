/// A source of vertical blanks that does as it is told, on a clock that stands still until it is waited on.
#pragma once

#include "render/vblank/vblank_clock.h"

namespace overt::test {

struct FakeVblanks final : VblankClock {
    explicit FakeVblanks(Clock& session_clock) : clock(&session_clock) {}

    Clock* clock;
    double hz = 100.0;
    std::int64_t first_count = 1'000'000; ///< at the clock's zero
    SessionDuration clock_error{};        ///< added to each stamp
    bool stamps_are_of_asking = false;
    bool stands_still = false;
    SessionTime dies_at = SessionTime::max();

    VblankSource source() const noexcept override { return VblankSource::drm_vblank; }
    std::optional<VblankStamp> last() noexcept override {
        const SessionTime now = clock->now();
        if (now >= dies_at)
            return std::nullopt;
        const auto passed = stands_still ? 0 : static_cast<std::int64_t>(to_seconds(now) * hz + 1e-6);
        const SessionTime blank(from_seconds(static_cast<double>(passed) / hz));
        return VblankStamp{first_count + passed, (stamps_are_of_asking ? now : blank) + clock_error};
    }
    std::optional<VblankStamp> await(std::int64_t count) noexcept override {
        if (stands_still)
            return std::nullopt;
        const SessionTime blank(from_seconds(static_cast<double>(count - first_count) / hz));
        clock->wait_until(blank);
        return last();
    }
};

} // namespace overt::test
