/// What was lit at each refresh of trials that another program presented.
#pragma once

#include "experiment/record/foreign/foreign_session.h"

namespace overt {

/// Gives each trial its flips and its end. By the log of frames, each row lasting until the next one, in
/// steps of the display's nominal refresh; without one as the protocol plans it from the onset on. Throws
/// InputError for frames or angles that the motion does not have, and for trials without any.
void add_flips(const SessionHeader& header, const std::optional<std::vector<LoggedFrame>>& frames,
               ForeignPlan& plan);

} // namespace overt
