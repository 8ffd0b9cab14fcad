#include "render/window/monitor_choice.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "experiment/base/error.h"

namespace overt {
namespace {

/// Of the rate: tells 59.94 from 60 Hz.
constexpr double same_rate = 5e-4;

std::string lines_of(std::span<const MonitorInfo> monitors) {
    std::string lines;
    for (const MonitorInfo& monitor : monitors)
        lines += "\n  " + describe(monitor);
    return monitors.empty() ? "\n  none" : lines;
}

bool has_size(const MonitorInfo& monitor, const MonitorWish& wish) {
    return !wish.size_px || monitor.size_px == *wish.size_px;
}

bool is_called(const MonitorInfo& monitor, const std::string& which) {
    return std::to_string(monitor.number) == which || monitor.name == which || monitor.edid_name == which;
}

const MonitorInfo& named(std::span<const MonitorInfo> monitors, const MonitorWish& wish) {
    const auto is_meant = [&](const MonitorInfo& monitor) { return is_called(monitor, wish.which); };
    const auto found = std::ranges::find_if(monitors, is_meant);
    if (found == monitors.end())
        throw InputError(fmt::format("there is no monitor \"{}\": give a number, the name of an output, or "
                                     "that of a monitor's EDID. There are:{}",
                                     wish.which, lines_of(monitors)));
    if (std::ranges::count_if(monitors, is_meant) > 1)
        throw InputError(fmt::format("several monitors are called \"{}\": give the observer's number, or the "
                                     "name of its output. There are:{}",
                                     wish.which, lines_of(monitors)));
    const MonitorInfo& monitor = *found;
    if (!has_size(monitor, wish))
        throw InputError(
            fmt::format("{} does not show {} x {} pixels now: set its mode, correct [display] width_px and "
                        "height_px, or take another. There are:{}",
                        describe(monitor), wish.size_px->x, wish.size_px->y, lines_of(monitors)));
    return monitor;
}

} // namespace

bool has_rate(const MonitorInfo& monitor, double refresh_hz, double tolerance) {
    constexpr double whole_rate_tolerance_hz = 1.0;
    return std::abs(monitor.refresh_hz - refresh_hz) <=
           (monitor.rate_is_exact ? tolerance * refresh_hz : whole_rate_tolerance_hz);
}

const MonitorInfo& choose_monitor(std::span<const MonitorInfo> monitors, const MonitorWish& wish) {
    if (!wish.which.empty())
        return named(monitors, wish);
    std::vector<const MonitorInfo*> fitting;
    for (const MonitorInfo& monitor : monitors)
        if (has_size(monitor, wish))
            fitting.push_back(&monitor);
    if (fitting.empty() && !wish.size_px)
        throw InputError("the window system has no monitor: attach one and switch it on");
    if (fitting.empty())
        throw InputError(
            fmt::format("no monitor shows {} x {} pixels now: set its mode, or correct [display] "
                        "width_px and height_px. There are:{}",
                        wish.size_px->x, wish.size_px->y, lines_of(monitors)));
    if (fitting.size() == 1)
        return *fitting.front();
    for (const double tolerance : {same_rate, largest_rate_deviation}) {
        const auto has_it = [&](const MonitorInfo* monitor) {
            return wish.refresh_hz && has_rate(*monitor, *wish.refresh_hz, tolerance);
        };
        if (std::ranges::count_if(fitting, has_it) == 1)
            return **std::ranges::find_if(fitting, has_it);
    }
    throw InputError(fmt::format(
        "{} monitors could be the observer's: name one with --monitor or [display] monitor, or switch the "
        "others off. There are:{}",
        fitting.size(), lines_of(monitors)));
}

} // namespace overt
