/// `overt play --live`.
#pragma once

#include <span>

#include "app/stimuli/stimulus_commands.h"
#include "experiment/stimulus/object.h"
#include "experiment/trial.h"

namespace overt {

/// Shows a stimulus as OpenGL draws it now, in a window until it is closed, or one frame as a picture. Gives
/// the exit code. Throws InputError, GraphicsError, RecordError.
int play_live(const Protocol& protocol, std::span<const Object> objects, const Stimulus& stimulus,
              const PlayOptions& options);

} // namespace overt
