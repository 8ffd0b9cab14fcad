/// Tests of a simulated study that are no difference of two levels: of factors, interactions, and clusters on
/// the surface.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "app/power/gaze_studies.h"
#include "app/power/vertex_maps.h"
#include "experiment/power/power_results.h"

namespace overt {

/// The columns of `--by` whose analysis has the effect's row in factor_effects: the task, that of the effect,
/// and that in which it interacts.
std::vector<std::string> columns_of_test(const PowerEffect& effect);

/// The row of factor_effects for the effect's column (PowerTest::factor), or for it and the column that
/// confines the effect (PowerTest::interaction), with the first observers of a study, by the numbers of them.
/// The estimate is the row's statistic.
std::vector<StudyOutcome> tested_factors(const GazeStudies& studies, const StudyResults& results,
                                         const PowerEffect& effect, std::span<const int> observers,
                                         const PermutationSettings& settings);

/// The least `p_of_all` of difference_clusters of any cluster between the effect's two levels, corrected over
/// all objects and pairs of levels of its column; 1 where there is no cluster. The estimate is the number of
/// clusters with no larger p than 0.05. `maps` by object.
std::vector<StudyOutcome> tested_clusters(const GazeStudies& studies, const StudyResults& results,
                                          const PowerEffect& effect, std::span<const int> observers,
                                          std::span<const std::unique_ptr<VertexMaps>> maps,
                                          const PermutationSettings& settings);

} // namespace overt
