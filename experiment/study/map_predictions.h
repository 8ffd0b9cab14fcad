/// How well fixations are told by maps that they did not make: KL, NSS, AUC and information gain.
#pragma once

#include <vector>

#include "experiment/study/fixation_maps.h"
#include "experiment/study/model_maps.h"

namespace overt {

/// For each group on each object, a row for each map that predicts its fixations: that of the other
/// observers in the same group, in the other levels of the compared column (everything else alike), and the
/// exposure. Each observer's fixations are predicted by others alone, also in other levels, so that the rows
/// can be compared with each other.
///
/// A predicting map is the sum of the n fixations that make it and of the exposure as one more, divided by
/// n + 1: gaze can go where few fixations have never been, and without that one such fixation would cost 50
/// bits. The rest is as in map_similarity.h and area_under_curve.h, over the places that could be seen.
/// Fixations count alike. `results.groups` must have been made.
///
/// Of each of the models two rows more: its density as it is, and times that of the exposure, since gaze
/// cannot go where nothing is seen; both with a hundredth of the exposure, for where a model has 0. The
/// ceiling of all predictions is the other observers' map of the same group: `share_of_ceiling` is a row's
/// gain over even gaze divided by its, of the observers who have both (Kümmerer, Wallis and Bethge, PNAS 112,
/// 2015, 16054-16059).
std::vector<MapPredictionRow> map_predictions(const StudyResults& results, const ObjectFixationMaps& maps,
                                              const StudyOptions& options,
                                              const std::vector<ModelMap>& models = {});

} // namespace overt
