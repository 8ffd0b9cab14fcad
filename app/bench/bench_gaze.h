/// Made-up recordings for benchmarks: gaze at 2000 Hz in presentations of the default experiment.
#pragma once

#include <vector>

#include "experiment/analysis/flip_history.h"
#include "experiment/clock_map.h"
#include "experiment/gaze.h"
#include "experiment/maps/coordinate_maps.h"
#include "experiment/protocol/protocol.h"
#include "experiment/screen_geometry.h"

namespace overt {

/// How the eye moves.
enum class GazeKind {
    fixations, ///< of 150 to 450 ms with their small movements, five in six on the object, joined by saccades
    uniform,   ///< a new place of the image in each sample
};

/// One presentation with its samples.
struct BenchRecording {
    FlipHistory history;
    ClockMap clock_map;
    std::vector<GazeSample> samples;
};

/// Presentations of the protocol's animation in which one refresh in 300 is missed. The same for the same
/// arguments.
std::vector<BenchRecording> bench_recordings(const Protocol& protocol, const ScreenGeometry& screen,
                                             const CoordinateMaps& maps, GazeKind kind, int presentations);

} // namespace overt
