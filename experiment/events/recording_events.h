/// Fixations, saccades and blinks of a whole recording: the one way in which they are found in samples that
/// are there already, be it for an export, an analysis or a benchmark.
#pragma once

#include <functional>
#include <optional>
#include <span>

#include "experiment/events/event_detector.h"
#include "experiment/events/event_thresholds.h"

namespace overt {

/// Takes samples of both eyes in the order of their times; `begins`: a recording begins with them, so that
/// nothing lasts from what was before until now.
using TakeGaze = std::function<void(std::span<const GazeSample> samples, bool begins)>;
/// Gives all samples of a recording, each time that it is called.
using ReadGaze = std::function<void(const TakeGaze&)>;

/// By what the events of a recording are found.
struct RecordingThresholds {
    EventSettings settings;
    std::optional<GazeNoise> measured; ///< nothing of fewer than two samples
};

/// Reads the recording once: those that were chosen, and for the rest those of its own rate and noise.
RecordingThresholds thresholds_for(const ReadGaze& read, const GazeAngles& angles,
                                   const ChosenThresholds& chosen);

/// Reads the recording once more. Trials do not matter: what an eye does across the begin of one is one
/// event.
void find_events(const ReadGaze& read, const GazeAngles& angles, const EventSettings& settings,
                 EventListener& listener);

} // namespace overt
