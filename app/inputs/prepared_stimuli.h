/// Stimuli made ready before a session, with progress on the terminal.
#pragma once

#include "experiment/protocol/protocol.h"
#include "render/stimulus/stimulus_library.h"

namespace overt {

/// Whether the hidden maps are made, too, or are drawn live later.
enum class MapsNow : std::uint8_t { made, drawn_live };

/// Draws and renders what the cache lacks. `least`: see StimulusLibrary::prepare_frames. An Interruption has
/// to live; Ctrl-C ends this with what is finished, as an Error.
void prepare_stimuli(StimulusLibrary& library, MapsNow maps, BakeQuality least);

} // namespace overt
