#include "app/cli/event_options.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

namespace overt {
namespace {

/// --velocity-deg-s for velocity_deg_s.
std::string option_name(const EventThreshold& threshold) {
    std::string name = fmt::format("--{}", threshold.key);
    std::ranges::replace(name, '_', '-');
    return name;
}

std::vector<CLI::Option*> added_thresholds(CLI::App& command, ChosenThresholds& thresholds) {
    std::vector<CLI::Option*> options;
    for (std::size_t i = 0; i < event_thresholds.size(); ++i) {
        const EventThreshold& threshold = event_thresholds[i];
        std::string what(threshold.what);
        std::erase(what, '`');
        const bool goes_with_gaze = threshold.setting == &EventSettings::velocity_deg_s ||
                                    threshold.setting == &EventSettings::acceleration_deg_s2;
        options.push_back(
            command
                .add_option(option_name(threshold), thresholds.values[i],
                            fmt::format("{} Default: {}", what,
                                        goes_with_gaze
                                            ? "goes with the rate and the noise of the gaze"
                                            : fmt::format("{}", EventSettings{}.*threshold.setting)))
                ->type_name(std::string(threshold.unit))
                ->check(CLI::Range(threshold.least, threshold.most)));
    }
    return options;
}

} // namespace

void add_threshold_options(CLI::App& command, ChosenThresholds& thresholds) {
    static_cast<void>(added_thresholds(command, thresholds));
}

void add_event_options(CLI::App& command, EventOptions& options, const std::string& what) {
    CLI::Option* const flag = command.add_flag("--detect-events", options.detects, what);
    for (CLI::Option* const threshold : added_thresholds(command, options.thresholds))
        threshold->needs(flag);
}

} // namespace overt
