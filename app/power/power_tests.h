/// The tests of one simulated study.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "app/power/gaze_studies.h"
#include "app/power/vertex_maps.h"
#include "experiment/power/power_results.h"
#include "experiment/study/level_comparisons.h"

namespace overt {

/// The comparisons of an effect's two levels: within each task where materials are compared, else within
/// objects alone. A cell's comparisons have all that in common but the observer and the object.
std::vector<std::vector<LevelComparison>>
compared_cells(const GazeStudies& studies, const StudyResults& results, const PowerEffect& effect);

/// The test of an effect with the first observers of a study, by the numbers of them. `maps` by object,
/// needed for CC. `equivalence`: PowerSettings has it; p is of that then.
std::vector<StudyOutcome> tested(const GazeStudies& studies, const StudyResults& results,
                                 const PowerEffect& effect, std::span<const int> observers,
                                 std::span<const std::unique_ptr<VertexMaps>> maps,
                                 const PermutationSettings& settings,
                                 const std::optional<double>& equivalence = {});

} // namespace overt
