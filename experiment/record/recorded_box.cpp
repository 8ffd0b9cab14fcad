#include "experiment/record/recorded_box.h"

#include <algorithm>

#include <fmt/format.h>

#include "experiment/clock_map.h"

namespace overt {
namespace {

/// The box in the tracker's place: both clocks count microseconds.
TrackerTime in_trackers_place(std::int64_t box_us) { return TrackerTime(TrackerClock::duration(box_us)); }

} // namespace

std::string_view name_of(RecordedBox::Use use) {
    switch (use) {
    case RecordedBox::Use::box:
        return "box";
    case RecordedBox::Use::declined:
        return "declined";
    case RecordedBox::Use::simulated:
        return "simulated";
    case RecordedBox::Use::no_mode:
        break;
    }
    return "not needed";
}

BoxClockFit fit_box_clock(const std::vector<BoxClockReading>& readings) {
    std::vector<ClockPair> pairs;
    for (const BoxClockReading& reading : readings)
        pairs.push_back({reading.before, in_trackers_place(reading.box_us), reading.after});
    const ClockMap map(pairs);
    BoxClockFit fit{static_cast<int>(readings.size()),
                    map.drift_ppm(),
                    map.drift_uncertainty_ppm(),
                    map.to_session(in_trackers_place(0)).time,
                    {}};
    for (const BoxClockReading& reading : readings)
        fit.uncertainty =
            std::max(fit.uncertainty, map.to_session(in_trackers_place(reading.box_us)).uncertainty);
    return fit;
}

std::string describe(const RecordedBox& box) {
    switch (box.use) {
    case RecordedBox::Use::box:
        return fmt::format("{}, serial number {}, firmware {}, at {}: {} after {:.2f} s, {:.2f} Hz",
                           box.product, box.serial_number, box.firmware_date, box.port, box.mode,
                           to_seconds(box.settled_after), box.video_rate_hz);
    case RecordedBox::Use::declined:
        return "none, as the protocol says";
    case RecordedBox::Use::simulated:
        return "none: nothing is shown on a real screen in real time";
    case RecordedBox::Use::no_mode:
        break;
    }
    return "none: the output needs none";
}

} // namespace overt
