/// An interrupted session, found and rebuilt from its record.
#pragma once

#include <filesystem>
#include <optional>

#include "app/session/session_commands.h"
#include "experiment/ports/session_history.h"
#include "experiment/record/read/session_record.h"
#include "experiment/record/resumption.h"
#include "experiment/record/session_directory.h"
#include "experiment/record/session_header.h"

namespace overt {

struct ResumedSession {
    std::filesystem::path folder;
    SessionHeader header;
    SessionHistory history; ///< up to and with being resumed now
    Resumption resumption;
    SessionTime clock_start; ///< a second after the last time that was recorded
};

/// A session that ended in order and whose manifest could not be finished then: finishes it, says so, and
/// gives true. The options as in take_up_session(). Throws RecordError.
bool finish_manifest(const RunOptions& options, const SessionPlace& place);

/// Finds the session that the options mean: --session N, or the last of the observer that is not complete;
/// says which it is and where it goes on. Throws InputError if there is none, if it is complete, or if
/// protocol, seed or clock are not those it was begun with; RecordError if it is running or cannot be read.
ResumedSession take_up_session(const RunOptions& options, const SessionPlace& place,
                               const Protocol& protocol);

/// Throws InputError if `now` would show something else than the session was begun with.
void require_same_stimuli(const ResumedSession& session, const SessionHeader& now);

/// What resuming the session means for the record of a further tracker: its attempts that do not count in the
/// session's own do not count in it either. `further`: its folder. Throws RecordError if it cannot be read.
Resumption resumption_of_further(const ResumedSession& session, const std::filesystem::path& further);

/// Throws InputError if the session was not begun with exactly these further trackers.
void require_same_trackers(const std::filesystem::path& session, std::vector<std::string> further_ids);

/// The observer was asked last, and did not agree to take part.
bool observer_declined(const SessionRecord& record);

} // namespace overt
