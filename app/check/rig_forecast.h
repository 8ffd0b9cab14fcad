/// What a session in real time would use on this machine: screen and display box.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "experiment/protocol/protocol.h"

namespace overt {

struct ForecastLine {
    std::string what, finding;
    bool is_refused = false; ///< a session would end here
};

/// Looks at screens and asks the display box, if one is needed. Opens no window. Never throws for what this
/// machine lacks: that is a line.
std::vector<ForecastLine> rig_forecast(const Protocol& protocol);

/// A heading and the lines.
std::string to_text(const std::vector<ForecastLine>& forecast);

nlohmann::ordered_json to_json(const std::vector<ForecastLine>& forecast);

} // namespace overt
