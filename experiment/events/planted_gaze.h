/// Gaze whose fixations, saccades and blinks are known, to measure the detector by.
#pragma once

#include <cstdint>
#include <vector>

#include "experiment/events/gaze_angles.h"
#include "experiment/gaze_event.h"

namespace overt {

struct PlantedGazeSettings {
    double rate_hz = 1000.0;
    double duration_s = 60.0;
    double noise_deg = 0.01; ///< standard deviation of each sample along each axis
    double shortest_saccade_deg = 1.0, longest_saccade_deg = 12.0;
    double blinks_per_minute = 10.0;
    double pursuit_deg_s = 0.0; ///< the target moves to and fro at this speed while the eye rests on it
    double jitter_s =
        0.0; ///< standard deviation of the time stamps, at most a tenth of the interval in effect
    Eye eye = Eye::right;
    std::uint64_t seed = 1;
};

struct PlantedGaze {
    std::vector<GazeSample> samples;
    /// What was planted, by the samples that lie in it, in order. A saccade lasts as long as the eye moves;
    /// one with a blink in it lasts from the first to the last movement of the lid.
    std::vector<GazeEvent> events;
};

/// Fixations of 150 to 600 ms on places within 8 degrees of the screen's middle; saccades of the main
/// sequence; blinks of 100 to 200 ms in which the pupil is lost, with 30 ms before and after in which the lid
/// draws the measured gaze down by up to three degrees. Repeatable.
PlantedGaze plant_gaze(const PlantedGazeSettings& settings, const ScreenGeometry& screen);

} // namespace overt
