/// What a session in real time with a protocol will do on this machine, before anybody starts one.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "experiment/protocol/protocol.h"

namespace overt {

struct OutlookLine {
    std::string what, finding;
    bool is_refused = false; ///< a session would end here
};

/// Looks at screens and asks the display box, if one is needed. Opens no window. Never throws for what this
/// machine lacks: that is a line.
std::vector<OutlookLine> session_outlook(const Protocol& protocol);

/// A heading and the lines.
std::string to_text(const std::vector<OutlookLine>& outlook);

nlohmann::ordered_json to_json(const std::vector<OutlookLine>& outlook);

} // namespace overt
