/// The eye trackers that a session can have.
#pragma once

#include <memory>
#include <string>

#include "devices/tracker/tracker_device.h"

namespace overt {

class FaultyTracker;

/// The one that a protocol names. Throws InputError for hardware in virtual time.
const TrackerDevice& tracker_device(TrackerKind kind, bool virtual_time);

/// What of a kind is found here, in a sentence, or why nothing can be; empty: there is nothing to look for.
std::string tracker_found(TrackerKind kind);

/// The tracker that a protocol names, calibrated by itself or by the program as [calibration] says.
struct MadeTracker {
    std::unique_ptr<EyeTracker> tracker;
    FaultyTracker* faulty = nullptr; ///< the part of it with which things go wrong, if they are to
};
/// Throws as the TrackerDevice and tracker_device(), and InputError for faults of hardware.
MadeTracker make_tracker(const TrackerParts& parts, bool virtual_time);

} // namespace overt
