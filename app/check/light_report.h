/// What surrounds the objects, in numbers: for who chooses a light to see gloss by.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "experiment/protocol/protocol.h"
#include "render/image/probe_facts.h"

namespace overt {

/// A light of the protocol with what is known of its surroundings: the probe with sun and lamps in it, as
/// seen from the object.
struct LightFacts {
    std::string id;
    std::optional<ProbeFacts> surroundings;
};

/// Of all lights. Throws InputError for a probe that cannot be read.
std::vector<LightFacts> measure_lights(const Protocol& protocol);

std::string to_text(const std::vector<LightFacts>& lights);
nlohmann::ordered_json to_json(const std::vector<LightFacts>& lights);

} // namespace overt
