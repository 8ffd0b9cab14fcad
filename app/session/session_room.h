/// Room on the disk for what a session will record.
#pragma once

#include <filesystem>

#include "app/inputs/protocol_inputs.h"
#include "app/session/session_plan.h"
#include "render/stimulus/stimulus_library.h"

namespace overt {

/// Throws RecordError, before anything of the session is written, if the disk of `sessions` has less room
/// than its record is going to take; of a resumed session that is what its remaining trials take. The
/// library's stimuli are prepared, its maps only with `with_prepared_maps`. A file system that does not tell
/// how much room it has is taken to have enough.
void require_room(const Experiment& experiment, const SessionPlan& plan, const StimulusLibrary& library,
                  bool with_prepared_maps, const std::filesystem::path& sessions);

} // namespace overt
