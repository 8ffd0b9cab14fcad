/// A session's timing in words and numbers, for people and for programs.
#pragma once

#include <optional>

#include <nlohmann/json_fwd.hpp>

#include "experiment/record/read/observer_turns.h"
#include "experiment/record/read/timing_report.h"

namespace overt {

/// To standard output: what was planned and lit, what was missed and why, and a histogram of intervals.
void print_timing(const TimingReport& report);

/// A line on how long what the observer did took to be seen; nothing where nothing was moved.
void print_input_delays(const std::optional<InputDelays>& delays);

/// All of it, times in ms. Without delays null.
nlohmann::ordered_json to_json(const std::optional<InputDelays>& delays);

/// All of it, times in ms.
nlohmann::ordered_json to_json(const TimingReport& report);

} // namespace overt
