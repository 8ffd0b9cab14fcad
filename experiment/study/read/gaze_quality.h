/// Data quality of a trial, from its samples and events alone.
#pragma once

#include <span>

#include "experiment/gaze_event.h"
#include "experiment/screen_geometry.h"
#include "experiment/study/fixations/placed_samples.h"
#include "experiment/study/results/study_results.h"

namespace overt {

/// Precision within each fixation, then the median over fixations of at least five samples. RMS-S2S is the
/// root mean square of the visual angles between successive samples. SD is the root of the sum of both axes'
/// variances, in degrees, around the motion of the eye: around the line of least squares through stretches of
/// 0.2 s, or of five samples if they take longer, divided by N - 2 for each of these. An eye that follows a
/// turning object scatters as one that rests on a still one. The rate is that of the median interval between
/// time stamps. Samples are lost where they have no gaze; those within the events' blinks are counted apart.
/// Accuracy, drift and refreshes are not set here.
StudyQuality gaze_quality(std::span<const PlacedSample> samples, std::span<const GazeEvent> events,
                          const ScreenGeometry& screen);

/// Of several trials together: sums of numbers, medians of precisions and rates, the mean of accuracies and
/// the largest of the worst.
StudyQuality quality_of_all(std::span<const StudyQuality* const> trials);

} // namespace overt
