/// The small experiment with some observers, analysed.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <catch2/catch.hpp>

#include "tests/app/small_experiment.h"

namespace overt::test {

/// Three observers, each with eyes and a tracker of its own.
class SmallStudy {
  public:
    explicit SmallStudy(std::string_view protocol = small_protocol) : experiment(protocol) {
        for (const std::string number : {"1", "2", "3"}) {
            REQUIRE(experiment
                        .overt({"run", experiment.protocol().string(), "--simulate-observer", number,
                                "--virtual-time", "--sessions", experiment.sessions().string(), "--observer",
                                "P0" + number, "--context", "osmesa", "--seed", number})
                        .exit_code == 0);
            sessions.push_back(experiment.session(1, "P0" + number).string());
        }
    }
    ProgramRun analyze(const std::filesystem::path& out, std::vector<std::string> more = {}) const {
        std::vector<std::string> arguments{"analyze",        "--format", "tsv",   "--resamples", "200",
                                           "--permutations", "100",      "--out", out.string()};
        arguments.insert(arguments.end(), sessions.begin(), sessions.end());
        arguments.insert(arguments.end(), more.begin(), more.end());
        return experiment.overt(arguments);
    }
    SmallExperiment experiment;
    std::vector<std::string> sessions;
};

} // namespace overt::test
