/// The clock of an Open Gaze server, made of what its records tell of time.
#pragma once

#include <optional>

#include "devices/opengaze/opengaze_message.h"
#include "experiment/session_time.h"

namespace overt {

/// The frequency that a server told for its counter TIME_TICK, if two of its records bear it out: what went
/// by on the counter is within 5 % of what went by of TIME, over 100 ms at least. Servers were seen to tell a
/// number that is no frequency (the example in the interface's own document is one).
std::optional<double> proven_tick_hz(std::optional<double> told_hz, const OpenGazeRecord& earlier,
                                     const OpenGazeRecord& later) noexcept;

/// Time of records: by TIME_TICK where its frequency is proven, else by TIME, in seconds. TIME begins anew
/// with each calibration: where a time goes back, or the source of time changes, the tracker's clock goes on
/// from the last record by the time that went by here. Nothing allocates or throws.
class OpenGazeClock {
  public:
    /// Seconds of the server's run by this frequency of TIME_TICK; none: by TIME.
    void use_ticks(std::optional<double> tick_hz) noexcept;

    /// Of a record that was here at `arrived`; nothing if it tells no time. Records in their order.
    std::optional<TrackerTime> time_of(const OpenGazeRecord& record, SessionTime arrived) noexcept;

  private:
    std::optional<double> tick_hz_;
    bool is_new_source_ = false;
    double offset_s_ = 0.0; ///< from what records tell to the tracker's time
    std::optional<double> last_s_;
    SessionTime last_arrived_;
};

} // namespace overt
