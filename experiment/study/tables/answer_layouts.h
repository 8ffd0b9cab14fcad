/// The tables of what observers answered.
#pragma once

#include <vector>

#include "experiment/record/tables/shared_columns.h"
#include "experiment/study/results/answer_rows.h"

namespace overt {

/// Each answer, with a column for each factor: of the trial where all that it shows is alike, and else of
/// each slot. The answers give the columns and must outlive the layout.
RowLayout<StudyAnswer> answer_trials_layout(const std::vector<StudyAnswer>& answers);
RowLayout<AnswerSummaryRow> answers_layout();
RowLayout<AnswerChoiceRow> answer_choices_layout();
RowLayout<AnswerCurveRow> psychometric_functions_layout();

/// A point of a curve.
struct AnswerPointRow {
    const AnswerCurveRow& curve;
    const AnswerCurvePoint& point;
};
RowLayout<AnswerPointRow> psychometric_points_layout();
RowLayout<AnswerTrackRow> procedure_tracks_layout();
RowLayout<AnswerTimeRow> response_times_layout();
RowLayout<AnswerSpeedRow> speed_and_accuracy_layout();
RowLayout<AnswerDifferenceRow> answer_differences_layout();
RowLayout<AnswerTrendRow> answer_trends_layout();

/// A point of a trend.
struct AnswerTrendPointRow {
    const AnswerTrendRow& trend;
    const AnswerTrendPoint& point;
};
RowLayout<AnswerTrendPointRow> answer_trend_points_layout();
RowLayout<AnswerLikenessRow> answer_likenesses_layout();
RowLayout<AnswerGazeRow> answer_gaze_layout();
RowLayout<GazeChoiceRow> gaze_choices_layout();
RowLayout<AnswerScaleRow> answer_scales_layout();
RowLayout<AnswerRatingRow> ratings_layout();
RowLayout<AnswerMatchRow> matches_layout();
RowLayout<AnswerMatchLineRow> match_lines_layout();

} // namespace overt
