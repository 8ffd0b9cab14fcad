/// Where the gaze and the trials of a session come from that another program presented.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "experiment/record/read/session_record.h"

namespace overt {

/// Kind of the events that say what an import took from where, and what it did not know.
inline constexpr std::string_view gaze_imported_event = "gaze imported";

struct ImportSource {
    std::string gaze; ///< the program that recorded it, as its tables tell
    std::string
        presenter; ///< the program that wrote the log of trials; without a log, `gaze`; empty: not known
    /// The first of the events: both, with their files and these' SHA-256.
    std::string text;
};

/// As the first event has it, whose words import_source_text() makes.
std::string import_source_text(const ImportSource& programs, std::string_view gaze_files,
                               std::string_view trial_files, bool has_log);

/// Nothing for a session of this program's own. Throws RecordError.
std::optional<ImportSource> import_source(const SessionRecord& record);

} // namespace overt
