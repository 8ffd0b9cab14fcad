/// What follows from the answers of a study: shares, sensitivity, psychometric functions, scales, ratings.
#pragma once

#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "experiment/study/results/answer_rows.h"
#include "experiment/study/results/study_options.h"

namespace overt {

/// The answers of each observer and of all together (an empty label), by task, answer and item.
using AnswersBy = std::map<AnswerOf, std::vector<const StudyAnswer*>>;
AnswersBy answers_by(std::span<const StudyAnswer> answers);

/// A file each: summaries and choices, curves, scales, ratings.
std::vector<AnswerSummaryRow> answer_summaries(const AnswersBy& answers, const StudyOptions& options);
std::vector<AnswerChoiceRow> answer_choices(const AnswersBy& answers, const StudyOptions& options);

/// Of choices between two slots, of which one always shows the same level of a factor or whose levels differ,
/// and of choices about a single stimulus, for each factor of numbers with three levels at least: logistic
/// functions by maximum likelihood. With one level that the other never falls below (or never exceeds) and
/// slots to choose from, the guess rate is one half and lapses up to 6 % are free; else both are 0. Of one
/// observer the interval is by the bootstrap over trials in their levels (from the fitted function where each
/// level has answers of one kind only), of all it is that of the observers' mean. Besides, those of each
/// level of each other factor in which trials differ (compared_columns) but the side.
std::vector<AnswerCurveRow> answer_curves(const AnswersBy& answers, const StudyOptions& options);

/// Of choices between two slots whose stimuli differ in one list: Bradley-Terry and Thurstone's Case V, with
/// the first slot's effect; whose stimuli differ in several factors of numbers, conjoint measurement. Of
/// choices among three or four slots whose stimuli are in order of one factor of numbers: difference scaling,
/// an answer being the slot of the pair that differs more.
std::vector<AnswerScaleRow> answer_scales(const AnswersBy& answers, const StudyOptions& options);

/// Means of scales and numbers, by each factor's levels and over all.
std::vector<AnswerRatingRow> answer_ratings(const AnswersBy& answers, const StudyOptions& options);

/// Of tasks whose levels a procedure chose: each trial in the order of its track.
std::vector<AnswerTrackRow> answer_tracks(std::span<const StudyAnswer> answers);

/// Distributions of response times: of all answers, of correct and of wrong ones where there are both, and of
/// each choice where nothing is correct; ex-Gaussian and shifted log-normal by maximum likelihood.
std::vector<AnswerTimeRow> answer_times(const AnswersBy& answers, const StudyOptions& options);

/// Correct answers by how fast they came (the conditional accuracy function): an observer's times in five
/// parts of equally many, from the fastest on; of all observers the mean of theirs. Where something is
/// correct, with ten times for each part at least.
std::vector<AnswerSpeedRow> answer_speeds(const AnswersBy& answers, const StudyOptions& options);

/// How often two levels of each factor in which stimuli differ stay together, of answers that choose the odd
/// one out: of each observer and of all. A row for each pair that was shown.
std::vector<AnswerLikenessRow> answer_likenesses(const AnswersBy& answers, const StudyOptions& options);

/// A factor, and two of its levels in the order of the alphabet.
using LevelPairOfFactor = std::pair<std::string, std::pair<std::string, std::string>>;

/// The share of the answers that leave a pair together, each answer counting by its weight; empty weights:
/// one each.
std::map<LevelPairOfFactor, double> likeness_shares(std::span<const StudyAnswer* const> answers,
                                                    std::span<const double> weights);

/// Settings of matches that were accepted, for each level of the reference, and the lines over references: of
/// an observer with intervals by drawing settings again, of all the means of the observers'. Besides, those
/// of each level of each other factor in which the references of trials differ.
void reckon_matches(StudyAnswers& answers, const AnswersBy& by, const StudyOptions& options);

/// All of these, and the differences between levels (answer_differences.h).
void reckon_answers(StudyAnswers& answers, const StudyOptions& options);

} // namespace overt
