#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/rig/tracker_devices.h"
#include "app/tracker/tracker_commands.h"

namespace overt {

int run_tracker_list(const TrackerListOptions& options) {
    auto json = nlohmann::ordered_json::array();
    for (const TrackerKind kind : all_kinds<TrackerKind>) {
        const TrackerKindRow& row = row_of(kind);
        const std::string_view can_do = tracker_device(kind, false).can_do;
        const std::string found = tracker_found(kind);
        json.push_back({{"kind", row.name},
                        {"what", row.explanation},
                        {"hardware", row.is_hardware()},
                        {"can_do", can_do},
                        {"found", found}});
        if (options.json)
            continue;
        fmt::print("{:<10} {}\n", row.name, row.explanation);
        if (!can_do.empty())
            fmt::print("{:<10} can:  {}\n", "", can_do);
        if (!found.empty())
            fmt::print("{:<10} here: {}\n", "", found);
    }
    if (options.json)
        fmt::print("{}\n", json.dump(2));
    return 0;
}

} // namespace overt
