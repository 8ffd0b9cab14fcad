/// What simulated observers mean to answer, beside what an analysis of their sessions found.
#pragma once

#include <filesystem>
#include <span>

#include "app/analyze/planted_truth.h"

namespace overt {

/// Sets the planted numbers of the results' answers, of observers who all have a seed: those that the same
/// analysis gives of shares and means as they are without noise (SimulatedAnswers::expected), in the very
/// trials that were run. Of psychometric functions the thresholds and slopes, of ratings the means, of
/// differences between levels those of thresholds, slopes, shares and means; of Thurstone's scales sqrt 2 x
/// slope x level, centred; of reliefs the gain of attitudes; of gaze before an answer the share of fixations
/// on the chosen slot (`look_share`). `sessions` in the order of the results. Throws RecordError.
void add_planted_answers(StudyResults& results, const Protocol& protocol, const ObserverSeeds& seeds,
                         std::span<const std::filesystem::path> sessions);

} // namespace overt
