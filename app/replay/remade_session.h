/// A session that cannot be presented again sample by sample, made again from its recorded flips and gaze.
#pragma once

#include <filesystem>

#include "app/cli/context_choice.h"
#include "app/inputs/protocol_inputs.h"
#include "app/replay/replay_report.h"
#include "experiment/record/read/session_record.h"

namespace overt {

struct RemakeRequest {
    const SessionRecord& record;
    const Experiment& experiment;
    std::filesystem::path cache;
    ContextChoice context;
    std::filesystem::path work; ///< a folder that stays until the report is told
};

/// Makes order, header, frames, maps, the program's fixations and all exports again, and adds to the report
/// what was compared, what was not, and what differs. Throws InputError for an imported recording, which
/// showed nothing of ours, and what making stimuli throws.
void remake_session(const RemakeRequest& request, ReplayReport& report);

} // namespace overt
