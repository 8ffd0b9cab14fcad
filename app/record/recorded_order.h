/// The order of a recorded session's trials, made again.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "experiment/record/session_header.h"
#include "experiment/trial.h"

namespace overt {

struct RecordedOrder {
    std::vector<Trial> recorded;
    std::vector<Trial> again; ///< as many, from the recorded protocol, observer and seed
    std::string why_not;      ///< there is no order to compare: the protocol cannot be read any more

    bool is_same() const { return why_not.empty() && again == recorded; }
};

/// Reads the recorded texts, and no file of theirs.
RecordedOrder recorded_order(const SessionHeader& header);

/// The order trial by trial, and whether it came out the same.
std::string to_text(const RecordedOrder& order, const SessionHeader& header);
nlohmann::ordered_json to_json(const RecordedOrder& order, const SessionHeader& header);

} // namespace overt
