/// The tables of what observers answered.
#pragma once

#include "experiment/record/tables/shared_columns.h"
#include "experiment/study/results/answer_rows.h"

namespace overt {

RowLayout<AnswerSummaryRow> answers_layout();
RowLayout<AnswerChoiceRow> answer_choices_layout();
RowLayout<AnswerCurveRow> psychometric_functions_layout();
RowLayout<AnswerScaleRow> answer_scales_layout();
RowLayout<AnswerRatingRow> ratings_layout();

} // namespace overt
