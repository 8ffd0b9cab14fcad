/// What was proved on the rig that a session ran on, as its record says.
#pragma once

#include <string>
#include <vector>

#include "experiment/record/read/session_record.h"

namespace overt {

/// Of one sitting.
struct NamedRigPage {
    int sitting = 1;
    std::string page; ///< "begun 2026-11-27T09:00:00Z, SHA-256 …; proved: …", or "none: …"
};

/// The page of the rig that each sitting in real time names, in their order; none of sessions in virtual
/// time, imported ones and those of programs that named none. Throws RecordError.
std::vector<NamedRigPage> rig_pages_of(const SessionRecord& record);

} // namespace overt
