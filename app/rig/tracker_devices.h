/// The eye trackers that a session can have: one row for each kind that a protocol may name.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

#include "experiment/ports/clock.h"
#include "experiment/ports/eye_tracker.h"
#include "experiment/protocol/protocol.h"

namespace overt {

class SimulatedObserver;

/// What a tracker can be made from. All of it must outlive the tracker.
struct TrackerParts {
    const TrackerSettings& settings;
    Clock& clock;
    const SimulatedObserver& observer; ///< whose gaze a simulated tracker measures
    std::uint64_t seed = 0;            ///< of everything simulated
};

struct TrackerDevice {
    std::string_view name;    ///< as in experiment/ports/tracker_kinds.h
    bool is_hardware = false; ///< measures in real time only
    /// Throws DeviceError if the tracker is not there, InputError for settings that it cannot have.
    std::unique_ptr<EyeTracker> (*make)(const TrackerParts& parts) = nullptr;
};

/// All of them, in the order of TrackerKind.
std::span<const TrackerDevice> tracker_devices();

/// The one that a protocol names. Throws InputError for hardware in virtual time.
const TrackerDevice& tracker_device(TrackerKind kind, bool virtual_time,
                                    std::span<const TrackerDevice> among = tracker_devices());

} // namespace overt
