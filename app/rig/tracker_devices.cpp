#include "app/rig/tracker_devices.h"

#include <fmt/format.h>

#include "devices/lsl/lsl_outlet.h"
#include "devices/simulated/faulty_tracker.h"
#include "devices/tracker/threaded_tracker.h"
#include "experiment/base/error.h"
#include "experiment/calibration/own_calibration.h"

namespace overt {
namespace {

std::unique_ptr<EyeTracker> threaded(std::unique_ptr<TrackerDriver> driver, const TrackerParts& parts) {
    const TrackerSettings& settings = parts.protocol.tracker;
    if (settings.outlet)
        driver =
            std::make_unique<LslGazeRelay>(std::move(driver), load_lsl({}), parts.protocol.name, parts.clock);
    return std::make_unique<ThreadedTracker>(std::move(driver), parts.clock,
                                             TrackerWish{.rate_hz = settings.rate_hz,
                                                         .eye = settings.analysed_eye(),
                                                         .both_eyes = settings.measures_both_eyes(),
                                                         .screen = screen_geometry_of(parts.protocol),
                                                         .file_name = parts.file_name});
}

/// In the order of their kinds.
const auto known_trackers =
    for_each_kind<TrackerKind>([]<TrackerKind kind> { return tracker_device_of<kind>(); });

} // namespace

const TrackerDevice& tracker_device(TrackerKind kind, bool virtual_time) {
    if (row_of(kind).is_hardware() && virtual_time)
        throw InputError(
            fmt::format("the eye tracker \"{}\" measures in real time: leave out --virtual-time, "
                        "or write [tracker] kind = \"simulated\"",
                        name_of(kind)));
    return known_trackers[static_cast<std::size_t>(kind)];
}

std::string tracker_found(TrackerKind kind) {
    const TrackerDevice& device = tracker_device(kind, false);
    try {
        return device.look_for ? device.look_for() : std::string();
    } catch (const Error& error) {
        return error.what();
    }
}

MadeTracker make_tracker(const TrackerParts& parts, bool virtual_time) {
    const TrackerDevice& device = tracker_device(parts.protocol.tracker.kind, virtual_time);
    const TrackerKindRow& kind = row_of(parts.protocol.tracker.kind);
    MadeTracker made;
    if (!parts.faults.are_none() && (kind.is_hardware() || !kind.measures_gaze))
        throw InputError(
            fmt::format("the faults of an eye tracker are simulated with one that is no hardware, "
                        "and not with \"{}\": give --tracker simulated",
                        kind.name));
    made.tracker =
        device.make_driver ? threaded(device.make_driver(parts), parts) : device.make_tracker(parts);
    if (!parts.faults.given.empty()) {
        auto faulty = std::make_unique<FaultyTracker>(std::move(made.tracker), parts.clock, parts.faults);
        made.faulty = faulty.get();
        made.tracker = std::move(faulty);
    }
    const CalibrationKeys& keys = parts.protocol.calibration;
    const bool calibrates = made.tracker->calibrates_itself();
    if (keys.by == CalibratedBy::tracker && !calibrates && !device.is_calibrated_elsewhere)
        throw InputError(fmt::format("the eye tracker \"{}\" cannot calibrate itself: write "
                                     "[calibration] by = \"overt\"",
                                     kind.name));
    if (made.tracker->measures_gaze() && keys.by != CalibratedBy::tracker &&
        !(keys.by == CalibratedBy::automatic && calibrates))
        made.tracker =
            std::make_unique<CalibratedTracker>(std::move(made.tracker), parts.clock, keys, parts.seed);
    return made;
}

} // namespace overt
