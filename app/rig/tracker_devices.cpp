#include "app/rig/tracker_devices.h"

#include <algorithm>
#include <cstdlib>

#include <fmt/format.h>

#include "devices/eyelink/eyelink_driver.h"
#include "devices/hid/hid_driver.h"
#include "devices/host/clocks.h"
#include "devices/host/no_eye_tracker.h"
#include "devices/link/tcp_line.h"
#include "devices/lsl/lsl_inlet.h"
#include "devices/lsl/lsl_outlet.h"
#include "devices/opengaze/opengaze_tracker.h"
#include "devices/pointer/pointer_driver.h"
#include "devices/pupil/pupil_tracker.h"
#include "devices/replay/replay_tracker.h"
#include "devices/simulated/faulty_tracker.h"
#include "devices/simulated/simulated_eye_tracker.h"
#include "devices/tobii/tobii_driver.h"
#include "devices/tracker/threaded_tracker.h"
#include "experiment/base/error.h"
#include "experiment/calibration/own_calibration.h"
#include "experiment/ports/tracker_kinds.h"
#include "experiment/stimulus/gaze_tags.h"

namespace overt {
namespace {

std::unique_ptr<EyeTracker> threaded(std::unique_ptr<TrackerDriver> driver, const TrackerParts& parts) {
    const TrackerSettings& settings = parts.protocol.tracker;
    // A library that the protocol names is that of the tracker's maker, but for streams.
    if (settings.outlet)
        driver = std::make_unique<LslGazeRelay>(
            std::move(driver),
            load_lsl(tracker_names[static_cast<std::size_t>(settings.kind)] == "lsl" ? settings.library
                                                                                     : std::string()),
            parts.protocol.name);
    return std::make_unique<ThreadedTracker>(std::move(driver), parts.clock,
                                             TrackerWish{.rate_hz = settings.rate_hz,
                                                         .eye = settings.analysed_eye(),
                                                         .both_eyes = settings.measures_both_eyes(),
                                                         .screen = screen_geometry_of(parts.protocol),
                                                         .file_name = parts.file_name});
}

/// What is found, or why nothing can be.
std::string found_or_why(std::string (*look)()) {
    try {
        return look();
    } catch (const Error& error) {
        return error.what();
    }
}

/// Whether a program answers at a tracker's usual address on this computer. Elsewhere nobody looks: that
/// would need an address.
std::string served_here(const NetworkAddress& usual, const std::string& program) {
    constexpr SessionDuration patience = std::chrono::milliseconds(200);
    SteadyClock clock;
    try {
        const TcpLine line(usual, program, clock, clock.now() + patience);
        return fmt::format("{} answers at {}", program, describe(usual));
    } catch (const Error&) {
        return fmt::format("{} does not answer at {}; on another computer it is found by [tracker] address",
                           program, describe(usual));
    }
}

std::string hid_trackers_found() {
    std::string found;
    for (const HidDeviceInfo& device : hid_devices())
        if (is_eye_tracker(device))
            found += fmt::format("{}{} {} at {}", found.empty() ? "" : "; ", device.manufacturer,
                                 device.product, device.path);
    return found.empty() ? "none is connected" : found;
}

LslLayoutSettings lsl_layout(const TrackerSettings& keys) {
    LslLayoutSettings layout;
    for (const std::string& channel : keys.channels)
        layout.assignments.push_back(parse_lsl_assignment(channel));
    constexpr LslUnit units[] = {LslUnit::as_told, LslUnit::px, LslUnit::normalized};
    layout.unit = units[static_cast<int>(keys.unit)];
    layout.y_is_up = keys.y_is_up;
    layout.least_confidence = keys.least_confidence;
    return layout;
}

constexpr TrackerDevice known_trackers[] = {
    {"simulated", false,
     [](const TrackerParts& parts) -> std::unique_ptr<EyeTracker> {
         SimulatedTrackerSettings settings = simulated_tracker_settings(parts.protocol.tracker);
         settings.uncalibrated = parts.protocol.calibration.by == CalibratedBy::overt;
         settings.rate_hz = parts.faults.granted_rate_hz.value_or(settings.rate_hz);
         return std::make_unique<SimulatedEyeTracker>(parts.clock, parts.observer, parts.seed, settings);
     }},
    {"replay", false,
     [](const TrackerParts& parts) -> std::unique_ptr<EyeTracker> {
         if (parts.protocol.calibration.by == CalibratedBy::overt)
             throw InputError(
                 "the gaze that the eye tracker \"replay\" plays back is calibrated already: leave out "
                 "[calibration] by = \"overt\"");
         return std::make_unique<ReplayTracker>(parts.protocol.tracker.address, parts.clock);
     }},
    {"eyelink", true,
     [](const TrackerParts& parts) -> std::unique_ptr<EyeTracker> {
         EyelinkSettings settings;
         settings.library = parts.protocol.tracker.library;
         settings.is_dummy = parts.protocol.tracker.address == "dummy";
         if (!settings.is_dummy && !parts.protocol.tracker.address.empty())
             settings.address = parts.protocol.tracker.address;
         settings.calibration_points = parts.protocol.calibration.points;
         settings.target_deg = parts.protocol.calibration.target_deg;
         return threaded(std::make_unique<EyelinkDriver>(settings, parts.clock), parts);
     },
     [] {
         return found_or_why([] {
             EyelinkLibrary();
             return std::string("its library is there");
         });
     },
     "up to 2000 Hz of one eye or 1000 Hz of both, calibrates itself, tells fixations and saccades, keeps a "
     "file of its own"},
    {"tobii", true,
     [](const TrackerParts& parts) -> std::unique_ptr<EyeTracker> {
         TobiiSettings settings;
         settings.library = parts.protocol.tracker.library;
         settings.device = parts.protocol.tracker.address;
         settings.calibration_points =
             calibration_targets(parts.protocol.calibration.points, parts.protocol.calibration.area,
                                 screen_geometry_of(parts.protocol));
         settings.target = Degrees{parts.protocol.calibration.target_deg};
         return threaded(std::make_unique<TobiiDriver>(settings, parts.clock), parts);
     },
     [] { return found_or_why(tobii_trackers_found); },
     "30 to 1200 Hz of both eyes, calibrates itself, tells changes of its input port"},
    {"opengaze", true,
     [](const TrackerParts& parts) -> std::unique_ptr<EyeTracker> {
         OpenGazeSettings settings;
         settings.server = parse_network_address(parts.protocol.tracker.address, settings.server);
         settings.point =
             parts.protocol.tracker.point == TrackedPoint::best ? OpenGazePoint::best : OpenGazePoint::eyes;
         for (const ScreenPoint target :
              calibration_targets(parts.protocol.calibration.points, parts.protocol.calibration.area,
                                  screen_geometry_of(parts.protocol)))
             settings.calibration_points.emplace_back(target.x_px / parts.protocol.display.width_px,
                                                      target.y_px / parts.protocol.display.height_px);
         return threaded(std::make_unique<OpenGazeTracker>(settings, parts.clock), parts);
     },
     [] { return served_here(OpenGazeSettings{}.server, "Gazepoint Control"); },
     "60 or 150 Hz of both eyes, calibrates itself; its clock is known to 50 ms"},
    {"pupil", true,
     [](const TrackerParts& parts) -> std::unique_ptr<EyeTracker> {
         return threaded(std::make_unique<PupilTracker>(pupil_settings_of(parts.protocol), parts.clock),
                         parts);
     },
     [] { return served_here(PupilSettings{}.remote, "Pupil Capture"); },
     "30 to 200 Hz of both eyes, calibrates itself without telling errors, keeps a recording of its own"},
    {"lsl", true,
     [](const TrackerParts& parts) -> std::unique_ptr<EyeTracker> {
         LslInletSettings settings;
         settings.library = parts.protocol.tracker.library;
         settings.stream = parts.protocol.tracker.address;
         settings.layout = lsl_layout(parts.protocol.tracker);
         return threaded(std::make_unique<LslInlet>(settings, parts.clock), parts);
     },
     [] {
         return found_or_why([] {
             load_lsl({});
             return std::string("its library is there");
         });
     },
     "what the stream has; its maker's program or overt calibrates"},
    {"hid", true,
     [](const TrackerParts& parts) -> std::unique_ptr<EyeTracker> {
         HidTrackerSettings settings;
         settings.device = parts.protocol.tracker.address;
         return threaded(std::make_unique<HidDriver>(settings, parts.clock), parts);
     },
     hid_trackers_found, "what its descriptor says; overt calibrates"},
    {"mouse", true,
     [](const TrackerParts& parts) -> std::unique_ptr<EyeTracker> {
         return threaded(std::make_unique<PointerDriver>(parts.clock), parts);
     },
     [] {
         return std::string(std::getenv("DISPLAY") ? "there is an X server"
                                                   : "there is no X server (DISPLAY)");
     },
     "1000 Hz of the pointer, in place of gaze"},
    {"none", false,
     [](const TrackerParts& parts) -> std::unique_ptr<EyeTracker> {
         return std::make_unique<NoEyeTracker>(parts.protocol.tracker.analysed_eye());
     }},
};

static_assert(std::ranges::equal(known_trackers, tracker_kinds, {}, &TrackerDevice::name,
                                 &TrackerKindRow::name),
              "each row of experiment/ports/tracker_kinds.h needs one here, in the same order");

} // namespace

PupilSettings pupil_settings_of(const Protocol& protocol) {
    PupilSettings settings;
    settings.remote = parse_network_address(protocol.tracker.address, settings.remote);
    settings.surface = protocol.tracker.surface;
    settings.least_confidence = protocol.tracker.least_confidence;
    const std::vector<TagPlace> tags = gaze_tags_of(screen_geometry_of(protocol), protocol.display);
    if (!tags.empty()) {
        const TaggedArea area = tagged_area(tags);
        settings.surface_place = {{area.origin_px.x, area.origin_px.y}, area.size_px.x, area.size_px.y};
    }
    return settings;
}

std::span<const TrackerDevice> tracker_devices() { return known_trackers; }

const TrackerDevice& tracker_device(TrackerKind kind, bool virtual_time,
                                    std::span<const TrackerDevice> among) {
    OVERT_EXPECTS(static_cast<std::size_t>(kind) < among.size());
    const TrackerDevice& device = among[static_cast<std::size_t>(kind)];
    if (device.is_hardware && virtual_time)
        throw InputError(
            fmt::format("the eye tracker \"{}\" measures in real time: leave out --virtual-time, "
                        "or write [tracker] kind = \"simulated\"",
                        device.name));
    return device;
}

MadeTracker make_tracker(const TrackerParts& parts, bool virtual_time) {
    const TrackerDevice& device = tracker_device(parts.protocol.tracker.kind, virtual_time);
    MadeTracker made;
    const bool measures_gaze =
        tracker_kinds[static_cast<std::size_t>(parts.protocol.tracker.kind)].measures_gaze;
    if (!parts.faults.are_none() && (device.is_hardware || !measures_gaze))
        throw InputError(
            fmt::format("the faults of an eye tracker are simulated with one that is no hardware, "
                        "and not with \"{}\": give --tracker simulated",
                        device.name));
    made.tracker = device.make(parts);
    if (!parts.faults.given.empty()) {
        auto faulty = std::make_unique<FaultyTracker>(std::move(made.tracker), parts.clock, parts.faults);
        made.faulty = faulty.get();
        made.tracker = std::move(faulty);
    }
    const CalibrationKeys& keys = parts.protocol.calibration;
    const bool calibrates = made.tracker->calibrates_itself();
    if (keys.by == CalibratedBy::tracker && !calibrates)
        throw InputError(fmt::format("the eye tracker \"{}\" cannot calibrate itself: write "
                                     "[calibration] by = \"overt\"",
                                     device.name));
    if (made.tracker->measures_gaze() && keys.by != CalibratedBy::tracker &&
        !(keys.by == CalibratedBy::automatic && calibrates))
        made.tracker =
            std::make_unique<CalibratedTracker>(std::move(made.tracker), parts.clock, keys, parts.seed);
    return made;
}

} // namespace overt
