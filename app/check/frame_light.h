/// How much of the stimuli's light the display can show.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "app/inputs/protocol_inputs.h"
#include "render/image/gamut.h"

namespace overt {

struct StimulusLight {
    std::string stimulus;    ///< stimulus_name()
    ClippedPixels clipped;   ///< of all its pages
    double worst_page = 0.0; ///< largest share of the object's pixels clipped in one channel of one page
};

/// Reads every page of every stimulus, drawing those that the cache lacks. Throws as StimulusLibrary does.
std::vector<StimulusLight> measure_light(const Experiment& experiment);

std::string to_text(const std::vector<StimulusLight>& stimuli);
nlohmann::ordered_json to_json(const std::vector<StimulusLight>& stimuli);

} // namespace overt
