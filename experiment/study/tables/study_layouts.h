/// The tables of a study, column by column.
#pragma once

#include "experiment/record/tables/row_layout.h"
#include "experiment/study/results/study_results.h"
#include "experiment/study/trial_summary.h"

namespace overt {

/// A fixation with its trial.
struct FixationRow {
    const StudyFixation& fixation;
    const StudyTrial& trial;
};

// `results` must outlive the layouts.
RowLayout<FixationRow> study_fixations_layout(const StudyResults& results);
RowLayout<TrialSummaryRow> study_trials_layout(const StudyResults& results);
RowLayout<StudyMap> study_maps_layout(const StudyResults& results);
RowLayout<DistributionRow> distributions_layout(const StudyResults& results);
RowLayout<PairRow> pairs_layout(const StudyResults& results);
RowLayout<TimeCourseRow> time_course_layout(const StudyResults& results);
RowLayout<MapPredictionRow> map_predictions_layout(const StudyResults& results);
RowLayout<MapReliabilityRow> map_reliability_layout(const StudyResults& results);
RowLayout<ExposureRow> exposure_layout(const StudyResults& results);
RowLayout<TemplateFitRow> template_fit_layout(const StudyResults& results);
RowLayout<ReportingItem> reporting_layout();
RowLayout<FactorEffectRow> factor_effects_layout();
RowLayout<GazeMotionRow> gaze_motion_layout(const StudyResults& results);
RowLayout<LightAtGazeRow> light_at_gaze_layout(const StudyResults& results);

/// A cluster of a map of differences.
struct ClusterRow {
    const DifferenceMap& map;
    const DifferenceMap::Cluster* cluster; ///< null: there is none
    int number = 0;                        ///< from 1, the largest first
};
RowLayout<ClusterRow> clusters_layout(const StudyResults& results);
RowLayout<ClusterRow> answer_clusters_layout(const StudyResults& results);

/// One of a trial or of a session.
struct QualityRow {
    const StudySession& session;
    const StudyTrial* trial; ///< null: of the whole session
    const StudyQuality& quality;
};
RowLayout<QualityRow> quality_layout();

} // namespace overt
