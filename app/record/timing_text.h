/// A session's timing in words and numbers, for people and for programs.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "experiment/record/read/timing_report.h"

namespace overt {

/// To standard output: what was planned and lit, what was missed and why, and a histogram of intervals.
void print_timing(const TimingReport& report);

/// All of it, times in ms.
nlohmann::ordered_json to_json(const TimingReport& report);

} // namespace overt
