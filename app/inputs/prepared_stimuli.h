/// Stimuli made ready before a session, with progress on the terminal.
#pragma once

#include <functional>

#include "experiment/protocol/protocol.h"
#include "render/stimulus/stimulus_library.h"

namespace overt {

/// Whether the hidden maps are made, too, or are drawn live later.
enum class MapsNow : std::uint8_t { made, drawn_live };

/// Draws and renders what the cache lacks. `least`: see StimulusLibrary::prepare_frames. `meanwhile`: called
/// now and then on this thread. An Interruption has to live; Ctrl-C ends this with what is finished, as an
/// Error.
void prepare_stimuli(StimulusLibrary& library, MapsNow maps, BakeQuality least,
                     const std::function<void()>& meanwhile = {});

/// The same for sessions that draw no frames: maps alone are made. What is said of the frames is the best
/// quality that there is, or that of those that would be made.
void prepare_maps_alone(StimulusLibrary& library, MapsNow maps, const Protocol& protocol,
                        const std::function<void()>& meanwhile = {});

} // namespace overt
