/// How an eye tracker of a kind is made. Beside the driver of each kind of experiment/ports/tracker_kinds.h
/// stands
///     template <> TrackerDevice tracker_device_of<kind_called<TrackerKind>("its name")>() { … }
/// without which the program is not linked: the linker names the row's number, from 0.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "devices/tracker/tracker_driver.h"
#include "experiment/ports/clock.h"
#include "experiment/ports/tracker_faults.h"
#include "experiment/protocol/protocol.h"

namespace overt {

class SimulatedObserver;

/// What a tracker can be made from. All of it must outlive the tracker.
struct TrackerParts {
    const Protocol& protocol;
    Clock& clock;
    const SimulatedObserver& observer; ///< whose gaze a simulated tracker measures
    std::uint64_t seed = 0;            ///< of everything simulated, and of the order of targets
    std::string file_name = "overt";   ///< see TrackerWish
    TrackerFaults faults = {};         ///< of a tracker that is no hardware
    std::filesystem::path notes = {};  ///< where a driver notes what outlives the session; empty: nowhere
};

/// What makes it throws DeviceError if the tracker is not there, InputError for settings that it cannot have.
struct TrackerDevice {
    /// Of hardware.
    std::unique_ptr<TrackerDriver> (*make_driver)(const TrackerParts& parts) = nullptr;
    std::string_view can_do = {}; ///< rates, calibration, what it tells besides samples
    /// What of it is found here, in a sentence. Throws Error, whose words say why nothing can be found.
    std::string (*look_for)() = nullptr;
    /// Of what is no hardware.
    std::unique_ptr<EyeTracker> (*make_tracker)(const TrackerParts& parts) = nullptr;
    /// A program of its maker can have calibrated it before the session: `by = "tracker"` is that.
    bool is_calibrated_elsewhere = false;
};

template <TrackerKind kind> TrackerDevice tracker_device_of();

} // namespace overt
