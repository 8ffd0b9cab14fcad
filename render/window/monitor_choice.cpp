#include "render/window/monitor_choice.h"

#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "experiment/base/error.h"

namespace overt {
namespace {

std::string lines_of(std::span<const MonitorInfo> monitors) {
    std::string lines;
    for (const MonitorInfo& monitor : monitors)
        lines += "\n  " + describe(monitor);
    return monitors.empty() ? "\n  none" : lines;
}

bool has_size(const MonitorInfo& monitor, const MonitorWish& wish) {
    return !wish.size_px || monitor.size_px == *wish.size_px;
}

bool has_rate(const MonitorInfo& monitor, double refresh_hz) {
    return std::abs(monitor.refresh_hz - refresh_hz) < 1.0;
}

const MonitorInfo& numbered(std::span<const MonitorInfo> monitors, const MonitorWish& wish) {
    const int number = *wish.number;
    if (number < 1 || number > static_cast<int>(monitors.size()))
        throw InputError(fmt::format("there is no monitor {}. There are:{}", number, lines_of(monitors)));
    const MonitorInfo& monitor = monitors[static_cast<std::size_t>(number) - 1];
    if (!has_size(monitor, wish))
        throw InputError(
            fmt::format("{} does not show {} x {} pixels now: set its mode, correct [display] width_px and "
                        "height_px, or take another. There are:{}",
                        describe(monitor), wish.size_px->x, wish.size_px->y, lines_of(monitors)));
    return monitor;
}

} // namespace

const MonitorInfo& choose_monitor(std::span<const MonitorInfo> monitors, const MonitorWish& wish) {
    if (wish.number)
        return numbered(monitors, wish);
    std::vector<const MonitorInfo*> fitting, of_rate;
    for (const MonitorInfo& monitor : monitors) {
        if (!has_size(monitor, wish))
            continue;
        fitting.push_back(&monitor);
        if (wish.refresh_hz && has_rate(monitor, *wish.refresh_hz))
            of_rate.push_back(&monitor);
    }
    if (fitting.empty() && !wish.size_px)
        throw InputError("the window system has no monitor: attach one and switch it on");
    if (fitting.empty())
        throw InputError(
            fmt::format("no monitor shows {} x {} pixels now: set its mode, or correct [display] "
                        "width_px and height_px. There are:{}",
                        wish.size_px->x, wish.size_px->y, lines_of(monitors)));
    if (fitting.size() == 1)
        return *fitting.front();
    if (of_rate.size() == 1)
        return *of_rate.front();
    throw InputError(
        fmt::format("{} monitors could be the observer's: name one with --monitor, or switch the "
                    "others off. There are:{}",
                    fitting.size(), lines_of(monitors)));
}

} // namespace overt
