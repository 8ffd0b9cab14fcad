/// How long what an observer presses takes to be seen on a screen of this machine.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "experiment/flip_report.h"
#include "experiment/ports/clock.h"
#include "experiment/timing/input_delays.h"
#include "render/window/window_context.h"

namespace overt {

/// From a key that the X server was given to the refresh that shows what it did.
struct InputLatency {
    int sent = 0; ///< presses
    int seen = 0; ///< of these, those that came
    /// From before a press was sent to the beginning of the refresh.
    std::optional<InputDelays> delays;
    double refresh_ms = 0.0; ///< median time between flips

    double median_refreshes() const { return delays ? 1e3 * delays->median_s / refresh_ms : 0.0; }
    /// "24.9 ms in the median, 95 % within 33.1 ms, 40.2 ms at the longest, of 120 presses".
    std::string description() const;
};

/// Keys are pressed at times drawn by `seed`, 30 to 150 ms apart, and looked for as a session does: after
/// each flip, for the next one. `flip`: shows another picture and gives when; it is told how many presses
/// there were so far. In a window of X, in real time; what keyboard, USB and kernel take before, and the
/// display after that, is not part of it. Throws GraphicsError where keys cannot be sent. Main thread only.
InputLatency measure_input_latency(WindowContext& window, const Clock& clock, double seconds,
                                   std::uint64_t seed, const std::function<FlipReport(int presses)>& flip);

} // namespace overt
