/// What follows from the answers of a study: shares, sensitivity, psychometric functions, scales, ratings.
#pragma once

#include <map>
#include <span>
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
/// observer the interval is by the bootstrap over trials in their levels, of all it is that of the observers'
/// mean.
std::vector<AnswerCurveRow> answer_curves(const AnswersBy& answers, const StudyOptions& options);

/// Of choices between two slots whose stimuli differ in one list: Bradley-Terry and Thurstone's Case V, with
/// the first slot's effect; whose stimuli differ in several factors of numbers, conjoint measurement. Of
/// choices among three or four slots whose stimuli are in order of one factor of numbers: difference scaling,
/// an answer being the slot of the pair that differs more.
std::vector<AnswerScaleRow> answer_scales(const AnswersBy& answers, const StudyOptions& options);

/// Means of scales and numbers, by each factor's levels and over all.
std::vector<AnswerRatingRow> answer_ratings(const AnswersBy& answers, const StudyOptions& options);

/// All of these.
void reckon_answers(StudyAnswers& answers, const StudyOptions& options);

} // namespace overt
