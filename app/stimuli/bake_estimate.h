/// What of a protocol's stimuli is rendered, how well, and what the rest will take on this machine.
#pragma once

#include <map>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "app/inputs/protocol_inputs.h"
#include "render/stimulus/stimulus_library.h"

namespace overt {

struct QualityEstimate {
    FrameQuality quality;
    int there = 0, frames = 0; ///< of all stimuli that are rendered, each that they share once
    double seconds_left = 0.0; ///< for what is missing, by a probe
};

struct BakeEstimate {
    std::vector<QualityEstimate> qualities;  ///< preview to reference; empty if nothing is rendered
    std::optional<FrameQuality> for_session; ///< what a session with an observer takes now
    BakeQuality wanted = BakeQuality::standard;
    std::optional<FrameQuality> for_simulated; ///< what one with a simulated observer takes now
    BakeQuality wanted_by_simulated = BakeQuality::preview;
};

/// How long paths take on this machine: traces a small picture of one object in each material, and
/// of each object where the material is translucent.
class PathProbe {
  public:
    /// Takes a second or two. The objects need a mesh to count.
    PathProbe(const Protocol& protocol, std::span<const Object> objects);

    /// For one frame of a stimulus, writing it included.
    double seconds_of_frame(const Stimulus& stimulus, const FrameQuality& quality) const;

  private:
    const Protocol* protocol_;
    std::vector<double> seconds_per_path_; ///< of each object in each material
    std::vector<double> traced_share_;     ///< of the picture, for each object
};

/// Looks into the cache; measures only if something is missing.
BakeEstimate bake_estimate(const Experiment& experiment, const StimulusLibrary& library);

/// "40 s", "12 min", "7.5 h".
std::string duration_text(double seconds);

/// For the top of what is said of a protocol: what a session with a person needs before it can begin, how
/// long that takes here, and the cheapest way that is honest with what it leaves.
std::string needs_of_person(const BakeEstimate& estimate, const Protocol& protocol);

std::string to_text(const BakeEstimate& estimate);
nlohmann::ordered_json to_json(const BakeEstimate& estimate);

} // namespace overt
