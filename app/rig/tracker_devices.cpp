#include "app/rig/tracker_devices.h"

#include <algorithm>

#include <fmt/format.h>

#include "devices/host/no_eye_tracker.h"
#include "devices/simulated/simulated_eye_tracker.h"
#include "experiment/base/error.h"
#include "experiment/ports/tracker_kinds.h"

namespace overt {
namespace {

constexpr TrackerDevice known_trackers[] = {
    {"simulated", false,
     [](const TrackerParts& parts) -> std::unique_ptr<EyeTracker> {
         return std::make_unique<SimulatedEyeTracker>(parts.clock, parts.observer, parts.seed,
                                                      simulated_tracker_settings(parts.settings));
     }},
    {"none", false,
     [](const TrackerParts& parts) -> std::unique_ptr<EyeTracker> {
         return std::make_unique<NoEyeTracker>(parts.settings.eye == "left" ? Eye::left : Eye::right);
     }},
};

static_assert(std::ranges::equal(known_trackers, tracker_kinds, {}, &TrackerDevice::name, &TrackerKindRow::name),
              "each row of experiment/ports/tracker_kinds.h needs one here, in the same order");

} // namespace

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

} // namespace overt
