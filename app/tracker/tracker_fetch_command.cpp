#include <set>

#include <fmt/format.h>

#include "app/cli/own_folders.h"
#include "app/cli/progress_bar.h"
#include "app/tracker/tracker_commands.h"
#include "devices/eyelink/eyelink_driver.h"
#include "devices/host/clocks.h"

namespace overt {

int run_tracker_fetch(const TrackerFetchOptions&) {
    const std::vector<LeftOnHost> left = read_left_on_host(state_folder());
    if (left.empty()) {
        fmt::print("no file of a session is known to be on an eye tracker's host\n");
        return 0;
    }
    std::set<std::string> hosts;
    for (const LeftOnHost& each : left)
        hosts.insert(each.host);
    SteadyClock clock;
    for (const std::string& host : hosts) {
        EyelinkSettings settings;
        settings.address = host;
        settings.notes = state_folder();
        ProgressBar bar;
        const std::vector<std::string> said =
            EyelinkDriver(settings, clock).fetch_left_files([&](std::int64_t done, std::int64_t total) {
                bar.update("fetching the eye tracker's file, kB", static_cast<int>(done / 1000),
                           static_cast<int>(std::max(done, total) / 1000));
            });
        bar.finish();
        for (const std::string& sentence : said)
            fmt::print("{}\n", sentence);
    }
    return read_left_on_host(state_folder()).empty() ? 0 : 1;
}

} // namespace overt
