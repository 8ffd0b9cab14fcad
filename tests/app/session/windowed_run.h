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

} // namespace overt::test
