/// Whether the observer agreed to take part, as it is recorded.
#pragma once

#include <string>

#include "experiment/session_time.h"

namespace overt {

/// That the observer agreed to take part, or did not.
struct RecordedConsent {
    std::string observer; ///< label
    bool accepted = false;
    SessionTime at;
    std::string utc; ///< the same by the wall clock, ISO 8601; set when it is written down
    std::string text_sha256;
    bool operator==(const RecordedConsent&) const = default;
};

} // namespace overt
