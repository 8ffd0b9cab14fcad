#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/rig/tracker_devices.h"
#include "app/tracker/tracker_commands.h"
#include "experiment/ports/tracker_kinds.h"

namespace overt {

int run_tracker_list(const TrackerListOptions& options) {
    auto json = nlohmann::ordered_json::array();
    const std::span<const TrackerDevice> devices = tracker_devices();
    for (std::size_t i = 0; i < devices.size(); ++i) {
        const TrackerDevice& device = devices[i];
        const std::string found = device.look_for ? device.look_for() : std::string();
        json.push_back({{"kind", device.name},
                        {"what", tracker_kinds[i].explanation},
                        {"hardware", device.is_hardware},
                        {"can_do", device.can_do},
                        {"found", found}});
        if (options.json)
            continue;
        fmt::print("{:<10} {}\n", device.name, tracker_kinds[i].explanation);
        if (!device.can_do.empty())
            fmt::print("{:<10} can:  {}\n", "", device.can_do);
        if (!found.empty())
            fmt::print("{:<10} here: {}\n", "", found);
    }
    if (options.json)
        fmt::print("{}\n", json.dump(2));
    return 0;
}

} // namespace overt
