/// Sessions in a window of their own, in real time.
#pragma once

#include <string>
#include <vector>

#include "tests/app/small_experiment.h"

namespace overt::test {

/// The arguments of observer P01's session in a window.
inline std::vector<std::string> windowed_run(const SmallExperiment& experiment,
                                             const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"run",
                                       experiment.protocol().string(),
                                       "--observer",
                                       "P01",
                                       "--context",
                                       "window",
                                       "--windowed",
                                       "--seed",
                                       "7",
                                       "--sessions",
                                       experiment.sessions().string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

/// An X server alone, whatever desktop the tests run on. The libraries behind a window keep memory until the
/// end of the process.
inline const std::vector<std::string> x_server_alone{
    "WAYLAND_DISPLAY=", "XDG_SESSION_TYPE=", "ASAN_OPTIONS=detect_leaks=0"};

} // namespace overt::test
