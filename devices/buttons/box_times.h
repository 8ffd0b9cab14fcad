/// When a button changed, on the session's clock.
#pragma once

#include <optional>
#include <vector>

#include "experiment/ports/button_box.h"

namespace overt {

/// Relates a box's clock of whole milliseconds to the session's, and times what has no clock by its arrival.
class BoxTimes {
  public:
    /// The box told `ms` between these two readings of the session clock: it was at some instant of that
    /// millisecond.
    void add_exchange(SessionTime before, std::uint32_t ms, SessionTime after);

    /// The box's clock went back to zero: what was known of it is worth nothing.
    void forget();

    /// Of a change at `ms` of the box's clock that was fetched at `fetched` and had not been there at
    /// `looked_before`. Without a clock reading as arrival().
    ButtonChange of(int button, bool is_down, std::uint32_t ms, SessionTime looked_before,
                    SessionTime fetched) const noexcept;

    /// Of a change without a time of its own: it happened between the two looks, or within `transport` before
    /// the first of them, which it then took to arrive.
    static ButtonChange arrival(int button, bool is_down, SessionTime looked_before, SessionTime fetched,
                                SessionDuration transport) noexcept;

  private:
    std::vector<BoxClockPair> pairs_;
    std::optional<BoxClockMap> map_;
};

/// What USB and its polling by the system take at most, for full-speed devices that ask to be polled every 10
/// ms.
inline constexpr SessionDuration usb_transport = std::chrono::milliseconds(10);

} // namespace overt
