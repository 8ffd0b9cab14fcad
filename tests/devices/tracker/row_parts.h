/// What the row of a tracker's kind makes its driver from, for tests of the rows.
#pragma once

#include "devices/tracker/tracker_device.h"
#include "tests/devices/simulated/sitting.h"

namespace overt::test {

struct RowParts {
    SimulatedSitting sitting{1};
    Protocol protocol;
    TrackerFaults faults;
    Clock* clock = &sitting.clock;
    std::filesystem::path notes;

    template <TrackerKind kind> std::unique_ptr<TrackerDriver> driver() {
        return tracker_device_of<kind>().make_driver(
            {.protocol = protocol, .clock = *clock, .observer = sitting.observer, .notes = notes});
    }
    template <TrackerKind kind> std::unique_ptr<EyeTracker> tracker() {
        return tracker_device_of<kind>().make_tracker({.protocol = protocol,
                                                       .clock = *clock,
                                                       .observer = sitting.observer,
                                                       .seed = 5,
                                                       .faults = faults});
    }
};

} // namespace overt::test
