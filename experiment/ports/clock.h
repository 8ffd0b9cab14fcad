/// The clock that all times of a session are read from.
#pragma once

#include "experiment/session_time.h"

namespace overt {

/// The session clock. Real: steady time since the session began. Virtual: stands still until wait_until() is
/// called. now() may be called from any thread.
class Clock {
  public:
    virtual ~Clock() = default;
    virtual SessionTime now() const noexcept = 0;
    /// Returns at `time` or, if that is past, at once.
    virtual void wait_until(SessionTime time) noexcept = 0;

    /// What other clocks of the machine say of this one's past.
    struct Disturbance {
        SessionDuration slept{};      ///< the machine was suspended so long; session time stood still then
        SessionDuration wall_moved{}; ///< the wall clock was set forward by this much, sleep not counted
    };
    /// Since the session began. Any thread; nothing is allocated.
    virtual Disturbance disturbance() const noexcept { return {}; }
};

} // namespace overt
