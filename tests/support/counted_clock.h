/// A clock that goes only where it is waited for.
#pragma once

#include <algorithm>
#include <vector>

#include "experiment/ports/clock.h"

namespace overt::test {

/// Each reading takes `reading`; waiting goes to the instant that is waited for, and is noted.
class CountedClock final : public Clock {
  public:
    mutable SessionTime time{std::chrono::seconds(100)};
    SessionDuration reading{};
    std::vector<SessionDuration> waits;
    SessionTime now() const noexcept override { return time += reading; }
    void wait_until(SessionTime until) noexcept override {
        waits.push_back(until - time);
        time = std::max(time, until);
    }
};

} // namespace overt::test
