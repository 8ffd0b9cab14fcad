/// The eye trackers that a session can have: one row for each kind that a protocol may name.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "experiment/ports/clock.h"
#include "experiment/ports/eye_tracker.h"
#include "experiment/ports/tracker_faults.h"
#include "experiment/protocol/protocol.h"

namespace overt {

class FaultyTracker;
class SimulatedObserver;
struct PupilSettings;

/// What a tracker can be made from. All of it must outlive the tracker.
struct TrackerParts {
    const Protocol& protocol;
    Clock& clock;
    const SimulatedObserver& observer; ///< whose gaze a simulated tracker measures
    std::uint64_t seed = 0;            ///< of everything simulated, and of the order of targets
    std::string file_name = "overt";   ///< see TrackerWish
    TrackerFaults faults = {};         ///< of a tracker that is no hardware
};

struct TrackerDevice {
    std::string_view name;    ///< as in experiment/ports/tracker_kinds.h
    bool is_hardware = false; ///< measures in real time only
    /// Throws DeviceError if the tracker is not there, InputError for settings that it cannot have.
    std::unique_ptr<EyeTracker> (*make)(const TrackerParts& parts) = nullptr;
    /// What of it is found here, in a sentence; null: there is nothing to look for.
    std::string (*look_for)() = nullptr;
    std::string_view can_do = {}; ///< of hardware: rates, calibration, what it tells besides samples
};

/// All of them, in the order of TrackerKind.
std::span<const TrackerDevice> tracker_devices();

/// The one that a protocol names. Throws InputError for hardware in virtual time.
const TrackerDevice& tracker_device(TrackerKind kind, bool virtual_time,
                                    std::span<const TrackerDevice> among = tracker_devices());

/// How a protocol wants Pupil Core. With tags around the stimulus the surface is what they span.
PupilSettings pupil_settings_of(const Protocol& protocol);

/// The tracker that a protocol names, calibrated by itself or by the program as [calibration] says.
struct MadeTracker {
    std::unique_ptr<EyeTracker> tracker;
    FaultyTracker* faulty = nullptr; ///< the part of it with which things go wrong, if they are to
};
/// Throws as TrackerDevice::make() and tracker_device(), and InputError for faults of hardware.
MadeTracker make_tracker(const TrackerParts& parts, bool virtual_time);

} // namespace overt
