/// A simulated observer who does not linger: a session in real time ends as soon as its screens allow.
#pragma once

#include <string>
#include <vector>

#include <fmt/format.h>

namespace overt::test {

/// Where the space bar is pressed at once; otherwise simulated observers read and answer as people do, for
/// some seconds each.
struct HurriedAt {
    bool task_screens = true, response_screens = true;
};

/// Options of `overt run` for the first `trials` trials.
inline std::vector<std::string> hurried(int trials, HurriedAt at = {}) {
    std::vector<std::string> options;
    const auto press = [&](const std::string& when) {
        options.insert(options.end(), {"--simulate-operator", when + "=press space"});
    };
    press("set-up+0.05");
    for (int trial = 1; trial <= trials; ++trial) {
        if (at.task_screens)
            press(fmt::format("task screen@{}+0.25", trial));
        if (at.response_screens)
            press(fmt::format("response screen@{}+0.25", trial));
    }
    press("end+0.05");
    return options;
}

} // namespace overt::test
