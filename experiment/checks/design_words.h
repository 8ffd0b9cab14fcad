/// What each task's trials are in each block, in plain words.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "experiment/protocol/protocol.h"

namespace overt {

/// A task in a block, or in the only one.
struct TaskWords {
    std::string block;                  ///< id; empty if the protocol has no blocks
    std::string task;                   ///< id
    int trials = 0;                     ///< of one observer, the one who has most
    double length_s = 0.0;              ///< of all of them, as reckoned for the session
    std::vector<std::string> sentences; ///< what is shown where, what is crossed, what is drawn
};

/// Task by task within each block, as listed. `trial_s`: how long a trial is reckoned to be.
std::vector<TaskWords> design_in_words(const Protocol& protocol, double trial_s);

nlohmann::ordered_json to_json(const std::vector<TaskWords>& parts);

} // namespace overt
