/// Trials whose gaze is planted sample by sample, to see whether a step that waits for gaze on a moving
/// object's area ends at the very sample at which it has to.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "experiment/protocol/protocol.h"
#include "experiment/stimulus/object.h"

namespace overt {

struct GazeStepTrials {
    int trials = 0;
    int at_planted_sample = 0; ///< onset and detection are those that were planted
    int again_from_record = 0; ///< and are the same when asked of the samples and flips afterwards
    int at_next_flip = 0;      ///< the step ended with the first flip after the sample had come
    std::int64_t samples = 0;  ///< that were looked at
    std::int64_t on_area = 0;  ///< of these, on the area
    double look_us = 0.0;      ///< mean time for a sample, the ray included
};

/// What each trial shows, at least one, and in whose slot gaze is waited for; the first leads.
struct GazeStepScene {
    std::vector<PlacedStimulus> shown = std::vector<PlacedStimulus>(1);
    std::size_t awaited = 0; ///< index into `shown`
};

/// Each trial: 2000 Hz gaze on the area of a name while the object turns, with refreshes that go by, a clock
/// of the tracker's own that runs apart, samples that come some milliseconds late, short visits to the area
/// that are no piece, a single sample outside before the last, and a blink within it in every second trial.
/// The area is looked for in the frame of the awaited slot that was lit on the gaze's row; gaze that is not
/// on it is beside it, or in another slot, on its stimulus's area of that name or not. The object in the
/// awaited slot must have the area. Deterministic but for `look_us`. Throws InputError.
GazeStepTrials simulate_gaze_steps(const Protocol& protocol, std::span<const Object> objects,
                                   const std::string& area, int trials, std::uint64_t seed,
                                   const GazeStepScene& scene = {});

} // namespace overt
