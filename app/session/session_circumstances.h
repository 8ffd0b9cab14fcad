/// What the record says of the machine and its devices, at a session's beginning, on its way and at its end.
/// What it says, the terminal says too.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/rig/rig.h"
#include "app/rig/rig_facts.h"
#include "app/session/session_commands.h"
#include "devices/host/thread_priority.h"
#include "experiment/design/schedule.h"
#include "experiment/record/write/session_store.h"

namespace overt {

/// See Rig::check_timing(): with a progress bar, and its risks said.
void check_timing(Rig& rig, double seconds);

/// What the record must know of the machine before the first trial; decodes the pages if `options` ask for
/// it. Throws as record_verification().
void note_circumstances(const RunOptions& options, const Protocol& protocol, const Schedule& schedule,
                        Rig& rig, SessionLog& log);

/// An eye tracker of the session, and its record.
struct RecordedTracker {
    std::string id; ///< of a further one; empty: the session's own
    const TrackerSettings& wish;
    EyeTracker& tracker;
    std::filesystem::path folder;
    SessionStore& store;
};

/// Which tracker it is, and what it granted of what was wished; tells it where its own file belongs.
void note_tracker(const RecordedTracker& recorded, const Clock& clock);

/// What is proved on this rig, by the page that was kept when it was set up. `folder`: see rig_folder().
void note_rig_page(const std::filesystem::path& folder, const RigFacts& rig, const Clock& clock,
                   SessionLog& log);

/// A session with simulated faults must not be taken for one on a real display. `file` may be empty: there
/// are none.
void note_faults(const std::filesystem::path& file, const Clock& clock, SessionLog& log);

/// How the session's thread is scheduled.
void note_thread(const std::vector<ThreadWish>& wishes, const Clock& clock, SessionLog& log);

/// Fetches the tracker's own file into its record's folder, if it has one, and records what it says.
void end_tracker(const RecordedTracker& recorded, const Clock& clock);

/// The same when the session itself has failed: its record may not take anything any more.
void rescue_tracker_file(const RecordedTracker& recorded);

} // namespace overt
