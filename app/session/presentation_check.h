/// A check of the presentation's timing before a session on a real screen.
#pragma once

#include <filesystem>

#include "app/rig/rig.h"
#include "experiment/design/schedule.h"
#include "experiment/record/write/session_store.h"

namespace overt {

/// Shows the first trial's stimulus for a period on a veiled screen, with maps, tracker and a record that is
/// thrown away and lies in a folder beside the session's `folder`, on the same disk; writes what it took into
/// the session's record and onto the terminal. Does nothing without a real screen or without trials. Throws
/// RecordError, and as Presenter::load_frames().
void check_presentation(Rig& rig, const Protocol& protocol, const Schedule& schedule,
                        const SessionHeader& header, const std::filesystem::path& folder,
                        SessionStore& store);

} // namespace overt
