#include "devices/opengaze/opengaze_clock.h"

#include <cmath>

#include "devices/tracker/tracker_seconds.h"

namespace overt {

std::optional<double> proven_tick_hz(std::optional<double> told_hz, const OpenGazeRecord& earlier,
                                     const OpenGazeRecord& later) noexcept {
    if (!(told_hz > 0.0) || !earlier.ticks || !later.ticks || !earlier.time_s || !later.time_s)
        return std::nullopt;
    const double by_time = *later.time_s - *earlier.time_s;
    const double by_ticks =
        (static_cast<double>(*later.ticks) - static_cast<double>(*earlier.ticks)) / *told_hz;
    if (by_time < 0.1 || std::abs(by_ticks - by_time) > 0.05 * by_time)
        return std::nullopt;
    return told_hz;
}

void OpenGazeClock::use_ticks(std::optional<double> tick_hz) noexcept {
    is_new_source_ = is_new_source_ || tick_hz != tick_hz_;
    tick_hz_ = tick_hz;
}

std::optional<TrackerTime> OpenGazeClock::time_of(const OpenGazeRecord& record,
                                                  SessionTime arrived) noexcept {
    std::optional<double> told = record.time_s;
    if (tick_hz_) {
        told.reset();
        if (record.ticks)
            told = static_cast<double>(*record.ticks) / *tick_hz_;
    }
    if (!told || !tracker_time_of_seconds(*told))
        return std::nullopt;
    double time_s = *told + offset_s_;
    if (last_s_ && (is_new_source_ || time_s < *last_s_)) {
        const double gone_on_s = *last_s_ + to_seconds(arrived - last_arrived_);
        offset_s_ += gone_on_s - time_s;
        time_s = gone_on_s;
    }
    is_new_source_ = false;
    last_s_ = time_s;
    last_arrived_ = arrived;
    return tracker_time_of_seconds(time_s);
}

} // namespace overt
