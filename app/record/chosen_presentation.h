/// Which of the stimuli that a trial shows at once is meant.
#pragma once

#include <string>

#include "experiment/record/read/session_record.h"

namespace overt {

/// The attempt as the presentation in the slot of that id; without an id, in its first. Throws InputError
/// naming the slots in which it shows something.
TrialRecord chosen_presentation(const SessionRecord& record, const TrialRecord& trial,
                                const std::string& slot);

} // namespace overt
