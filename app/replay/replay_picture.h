/// A frame of a recorded trial as it was displayed, with the gaze on it, as a picture; and a trial as a
/// movie.
#pragma once

#include <filesystem>

#include "app/replay/replay_commands.h"
#include "app/replay/shown_frames.h"
#include "render/image/linear_image.h"

namespace overt {

/// Draws each sample as a dot and their mean as a ring into a displayed frame. `frame` is composed over the
/// display's background, linear grey.
LinearImage with_gaze(const LinearImage& frame, const ShownFrame& shown, double background);

/// `--picture` and `--movie`: what is done and told of one trial. Gives the exit code. Throws InputError for
/// a frame that there is not, a file that exists, and what making stimuli throws.
int draw_trial(const SessionRecord& record, const ReplayOptions& options);

} // namespace overt
