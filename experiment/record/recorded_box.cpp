#include "experiment/record/recorded_box.h"

#include <algorithm>

#include <fmt/format.h>

namespace overt {

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

BoxClockFit fit_box_clock(const std::vector<BoxClockPair>& readings) {
    const BoxClockMap map(readings);
    BoxClockFit fit{static_cast<int>(readings.size()),
                    map.drift_ppm(),
                    map.drift_uncertainty_ppm(),
                    map.to_session(BoxTime()).time,
                    {}};
    for (const BoxClockPair& reading : readings)
        fit.uncertainty = std::max(fit.uncertainty, map.to_session(reading.other).uncertainty);
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
