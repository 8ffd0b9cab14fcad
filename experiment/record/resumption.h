/// How an interrupted session is taken up again.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "experiment/events/event_settings.h"
#include "experiment/ports/session_history.h"
#include "experiment/screen_geometry.h"

namespace overt {

/// What taking a session up again makes of what was there.
struct Resumption {
    ResumePolicy policy = ResumePolicy::redo;
    std::optional<int> skipped;           ///< index of the trial that does not come again
    std::vector<std::int64_t> superseded; ///< attempts (TrialRecord::id) of a restarted block
    std::vector<int> restarted;           ///< its trials: none of them is skipped any more
};

/// By which thresholds the events of a sitting are found while it runs, and in front of which screen.
struct SittingDetection {
    EventSettings settings;
    ScreenGeometry screen;
};

/// One of the command's options that a sitting was run with, by its name without dashes.
struct RecordedOption {
    std::string name, value;
    bool operator==(const RecordedOption&) const = default;
};

/// Who begins a sitting, and when.
struct Sitting {
    std::string started_utc; ///< wall clock, ISO 8601
    std::string program_version, program_sha256;
    std::optional<Resumption> resumption;      ///< nothing for the first
    std::optional<SittingDetection> detection; ///< nothing: nobody looks for events
    std::vector<RecordedOption> options = {};  ///< that decide what is recorded, in any order
};

} // namespace overt
