/// Stimuli side by side, for a look.
#pragma once

#include "app/stimuli/bake_plan.h"

namespace overt {

/// A frame of each stimulus, objects below one another, materials side by side, with their titles; cells
/// at most `cell_px` wide and high. Linear light, for write_srgb_png.
LinearImage contact_sheet(const Protocol& protocol, const StimulusLibrary& library, int frame, int cell_px);

/// Up to `count` frames of a stimulus side by side, spread evenly over the range, each with its number.
LinearImage film_strip(const StimulusLibrary& library, const Stimulus& stimulus, const FrameRange& frames,
                       int count, int cell_px);

} // namespace overt
