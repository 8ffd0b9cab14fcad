#include "experiment/study/study_layouts.h"

#include "experiment/record/tables/joined_cells.h"
#include "experiment/study/layout_parts.h"

namespace overt {

namespace {

/// Observer, trial, and the usual factors, of anything that is of a trial.
template <class Row> StudyColumns<Row> trial_columns(const StudyResults& results) {
    const auto factor = [](const char* column) {
        return [column](const Row& row) -> const std::string& { return row.trial.key(column); };
    };
    auto columns = joined_columns<Row>(
        text_column<Row>("observer", "Label of the observer", factor("observer")),
        text_column<Row>(
            "session_folder", "Folder of the session",
            [&results](const Row& row) { return of(results.sessions, row.trial.session).folder; }),
        count_column<Row>("trial", "Position of the trial in the observer's order, from 1",
                          [](const Row& row) { return row.trial.number; }),
        text_column<Row>("task", "Which question was asked", factor("task")),
        text_column<Row>("sculpture", "Which sculpture was shown", factor("sculpture")),
        text_column<Row>("material", "In which material it was shown", factor("material")));
    for (const std::string& column :
         others_of(results.by, {"observer", "session_folder", "trial", "task", "sculpture", "material"}))
        add_columns<Row>(columns,
                         text_column<Row>(column, "As in the table of trials",
                                          [column](const Row& row) { return row.trial.key(column); }));
    return columns;
}

template <class Row, class Member>
auto fixation_number(const char* name, const char* meaning, const char* unit, int decimals, Member member) {
    return number_column<Row>(name, meaning, unit, decimals, [member](const Row& row) {
        return std::optional<double>(member(row.fixation));
    });
}

} // namespace

RowLayout<FixationRow> study_fixations_layout(const StudyResults& results) {
    using Row = FixationRow;
    const auto axis = [&results](int which) {
        return [&results, which](const Row& row) -> std::optional<double> {
            const auto& mm = of(results.sculptures, row.trial.sculpture).mm_per_unit;
            return row.fixation.part && mm ? std::optional(row.fixation.position[which] * *mm) : std::nullopt;
        };
    };
    return {
        "fixations",
        "One row for each fixation of the trials that count, re-projected sample by sample through the "
        "frames "
        "lit meanwhile.",
        joined_columns<Row>(
            trial_columns<Row>(results),
            fixation_number<Row>("onset_s", "Begin since the presentation's onset", "s", second_decimals,
                                 [](auto& f) { return f.onset_s; }),
            fixation_number<Row>("duration_s", "Duration, cut at the presentation's end", "s",
                                 second_decimals, [](auto& f) { return f.duration_s; }),
            fixation_number<Row>("x_px", "Mean place on the screen, from the left", "px", pixel_decimals,
                                 [](auto& f) { return f.place.x_px; }),
            fixation_number<Row>("y_px", "Mean place on the screen, from the top", "px", pixel_decimals,
                                 [](auto& f) { return f.place.y_px; }),
            count_column<Row>("counted", "1 if it is counted in the results, else 0",
                              [](const Row& row) { return row.fixation.counted() ? 1 : 0; }),
            text_column<Row>("why", "counted, or why not",
                             [](const Row& row) { return name_of(row.fixation.why); }),
            count_column<Row>("samples", "Samples with gaze while a frame was lit",
                              [](const Row& row) { return row.fixation.samples; }),
            fixation_number<Row>("on_surface", "Share of these that met the sculpture", "", share_decimals,
                                 [](auto& f) { return f.on_surface; }),
            fixation_number<Row>("within_reach",
                                 "Share that missed it by no more than the reach, placed at its outline", "",
                                 share_decimals, [](auto& f) { return f.within_reach; }),
            count_column<Row>("only_by_reach",
                              "1 if it is counted and would not be without the reach, else 0",
                              [](const Row& row) { return row.fixation.only_by_reach ? 1 : 0; }),
            text_column<Row>("part", "The part with most of both",
                             [&results](const Row& row) -> std::string {
                                 const auto& names = of(results.sculptures, row.trial.sculpture).part_names;
                                 return row.fixation.part && *row.fixation.part < names.size()
                                            ? names[*row.fixation.part]
                                            : std::string();
                             }),
            number_column<Row>("x_mm", "Place on the surface, object coordinates in apparent mm", "mm",
                               place_decimals, axis(0)),
            number_column<Row>("y_mm", "The same, y", "mm", place_decimals, axis(1)),
            number_column<Row>("z_mm", "The same, z, upwards", "mm", place_decimals, axis(2)),
            number_column<Row>("spread_mm", "Root mean square distance of its samples from that place", "mm",
                               place_decimals, [](const Row& row) { return row.fixation.spread_mm; }),
            number_column<Row>("spread_deg", "The same, as the observer sees it", "deg", place_decimals,
                               [](const Row& row) { return row.fixation.spread_deg; }),
            number_column<Row>(
                "cone_at_edge",
                "Share of the tracker's gaze cone beside the sculpture, or on another sheet of it", "",
                share_decimals, [](const Row& row) { return row.fixation.cone_at_edge; }),
            number_column<Row>(
                "evidence_head",
                "How probable its place is, per square pixel and with the tracker's error, if the head was "
                "looked at; n/a: the error is not known",
                "1/px^2", density_decimals,
                [](const Row& row) {
                    return row.fixation.evidence ? std::optional(row.fixation.evidence->head) : std::nullopt;
                }),
            number_column<Row>("evidence_elsewhere", "The same if another part was", "1/px^2",
                               density_decimals,
                               [](const Row& row) {
                                   return row.fixation.evidence
                                              ? std::optional(row.fixation.evidence->elsewhere)
                                              : std::nullopt;
                               }),
            fixation_number<Row>("angle_deg", "Turn of the sculpture halfway through", "deg", pixel_decimals,
                                 [](auto& f) { return f.mid_angle_deg; }))};
}

RowLayout<TrialSummaryRow> study_trials_layout(const StudyResults& results) {
    using Row = TrialSummaryRow;
    return {
        "trials", "One row for each trial that came to its end, with what its counted fixations come to.",
        joined_columns<Row>(
            trial_columns<Row>(results),
            count_column<Row>("excluded", "1 if a rule excludes it, else 0",
                              [](const Row& row) { return row.trial.excluded ? 1 : 0; }),
            text_column<Row>("why_excluded", "The rule; n/a: not excluded",
                             [](const Row& row) { return row.trial.why_excluded; }),
            number_column<Row>("presentation_s", "Duration of the presentation", "s", second_decimals,
                               [](const Row& row) { return std::optional(row.trial.presentation_s); }),
            count_column<Row>("fixations", "Counted fixations", [](const Row& row) { return row.counted; }),
            number_column<Row>("on_head", "Of these on the head; n/a: the sculpture has none", "", 0,
                               [](const Row& row) {
                                   return row.has_head.value_or(false) ? std::optional<double>(row.on_head)
                                                                       : std::nullopt;
                               }),
            number_column<Row>("fixated_s", "Time of counted fixations", "s", second_decimals,
                               [](const Row& row) { return std::optional(row.counted_s); }),
            number_column<Row>("head_s", "Of these on the head", "s", second_decimals,
                               [](const Row& row) {
                                   return row.has_head.value_or(false) ? std::optional(row.head_s)
                                                                       : std::nullopt;
                               }),
            number_column<Row>("wss_mm2", "Mean within-cluster sum of squares of these, two at least", "mm^2",
                               place_decimals, [](const Row& row) { return row.wss_mm2; }))};
}

RowLayout<HeadFractionRow> head_fractions_layout(const StudyResults& results) {
    using Row = HeadFractionRow;
    return {
        "figure4_head_fraction",
        "Share of counted fixations on the head: of groups, of each level of each column, and of all.",
        joined_columns<Row>(
            key_columns<Row>(
                results.by, [](const Row& row) -> auto& { return row.keys; }),
            estimate_columns<Row>(
                "by_count", "Mean over observers of their shares of fixations", "", share_decimals,
                [](const Row& row) -> auto& { return row.by_count; }),
            estimate_columns<Row>(
                "by_duration", "The same of the time of fixation", "", share_decimals,
                [](const Row& row) -> auto& { return row.by_duration; }),
            estimate_columns<Row>(
                "corrected",
                "The same by count with the tracker's error taken out: each observer's share under which "
                "the measured places of the fixations are most probable",
                "", share_decimals, [](const Row& row) -> auto& { return row.corrected; }),
            number_column<Row>(
                "planted",
                "Of simulated observers whose seeds are known: the share that they mean for the head", "",
                share_decimals, [](const Row& row) { return row.planted; }),
            number_column<Row>("pooled", "Share of all observers' fixations together, as the paper has it",
                               "", share_decimals, [](const Row& row) { return row.pooled; }),
            number_column<Row>(
                "pooled_low", "Lower end of Wilson's interval, as if fixations were independent", "",
                share_decimals,
                [](const Row& row) {
                    return row.pooled_interval ? std::optional(row.pooled_interval->low) : std::nullopt;
                }),
            number_column<Row>("pooled_high", "Its upper end", "", share_decimals,
                               [](const Row& row) {
                                   return row.pooled_interval ? std::optional(row.pooled_interval->high)
                                                              : std::nullopt;
                               }),
            count_column<Row>("observers", "Observers", [](const Row& row) { return row.observers; }),
            count_column<Row>("trials", "Trials", [](const Row& row) { return row.trials; }),
            count_column<Row>("fixations", "Counted fixations",
                              [](const Row& row) { return row.fixations; }))};
}

RowLayout<DistributionRow> distributions_layout(const StudyResults& results) {
    using Row = DistributionRow;
    StudyColumns<Row> variances;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::string name{"xyz"[axis]};
        add_columns<Row>(variances,
                         number_column<Row>("var_" + name + "_mm2", "Variance of " + name + ", divided by N",
                                            "mm^2", place_decimals,
                                            [axis](const Row& row) { return row.variance_mm2[axis]; }));
        add_columns<Row>(variances,
                         number_column<Row>("var_" + name + "_deg2", "The same", "deg^2", place_decimals,
                                            [axis](const Row& row) { return row.variance_deg2[axis]; }));
    }
    return {
        "figure5_distribution",
        "How the fixations of a group scatter on one sculpture; those of all observers together.",
        joined_columns<Row>(
            group_columns<Row>(results),
            estimate_columns<Row>(
                "wss_mm2", "Mean within-cluster sum of squares: the sum of the three variances", "mm^2",
                place_decimals, [](const Row& row) -> auto& { return row.wss_mm2; }),
            estimate_columns<Row>(
                "wss_deg2", "The same in degrees at the depth of the axis", "deg^2", place_decimals,
                [](const Row& row) -> auto& { return row.wss_deg2; }),
            number_column<Row>("planted_wss_mm2",
                               "Of simulated observers: the same of the places that they mean to look at",
                               "mm^2", place_decimals, [](const Row& row) { return row.planted_wss_mm2; }),
            std::move(variances),
            number_column<Row>("map_peak", "Highest density of the map by duration, of a trial", "ms/mm^2",
                               density_decimals, [](const Row& row) { return row.map_peak; }),
            number_column<Row>("map_mean", "Its mean over the surface", "ms/mm^2", density_decimals,
                               [](const Row& row) { return row.map_mean; }),
            count_column<Row>("observers", "Observers", [](const Row& row) { return row.observers; }),
            count_column<Row>("fixations", "Counted fixations",
                              [](const Row& row) { return row.fixations; }))};
}

RowLayout<PairRow> pairs_layout(const StudyResults& results) {
    using Row = PairRow;
    const char* const holm_words =
        "The same, corrected after Holm for the rows of the table, those over all groups apart";
    const auto similarity = [](const std::string& name, const std::string& what, auto member) {
        return joined_columns<Row>(
            estimate_columns<Row>(
                name, what + " of both maps, mean over observers", "",
                share_decimals, [member](const Row& row) -> auto& { return (row.*member).value; }),
            estimate_columns<Row>(
                name + "_ceiling",
                "The same of random halves of one level's fixations, at the full number of "
                "fixations: what equal distributions give",
                "", share_decimals, [member](const Row& row) -> auto& { return (row.*member).ceiling; }),
            estimate_columns<Row>(
                name + "_null", "The same with the levels of fixations exchanged at random", "",
                share_decimals, [member](const Row& row) -> auto& { return (row.*member).null; }),
            number_column<Row>(name + "_p", "How often exchange gives as little", "", share_decimals,
                               [member](const Row& row) { return (row.*member).p; }));
    };
    return {
        "table1_pairs",
        "Two levels of a factor compared within observers: means over observers of the means over their "
        "sculptures.",
        joined_columns<Row>(
            key_columns<Row>(
                others_of(results.by, {"sculpture"}), [](const Row& row) -> auto& { return row.keys; }),
            text_column<Row>("compared", "The column whose levels are compared",
                             [](const Row& row) { return row.column; }),
            text_column<Row>("a", "First level", [](const Row& row) { return row.a; }),
            text_column<Row>("b", "Second level", [](const Row& row) { return row.b; }),
            estimate_columns<Row>(
                "wss_difference_mm2", "WSS of a less that of b", "mm^2", place_decimals,
                [](const Row& row) -> auto& { return row.wss_difference_mm2; }),
            estimate_columns<Row>(
                "wss_difference_deg2", "The same", "deg^2", place_decimals,
                [](const Row& row) -> auto& { return row.wss_difference_deg2; }),
            number_column<Row>("wss_p", "Of flipping the signs of observers' differences, two-sided", "",
                               share_decimals, [](const Row& row) { return row.wss_p; }),
            number_column<Row>("wss_p_holm", holm_words, "", share_decimals,
                               [](const Row& row) { return row.wss_p_holm; }),
            estimate_columns<Row>(
                "head_difference", "Share of fixations on the head, of a less that of b", "", share_decimals,
                [](const Row& row) -> auto& { return row.head_difference; }),
            number_column<Row>("head_p", "Of flipping the signs of observers' differences, two-sided", "",
                               share_decimals, [](const Row& row) { return row.head_p; }),
            number_column<Row>("head_p_holm", holm_words, "", share_decimals,
                               [](const Row& row) { return row.head_p_holm; }),
            number_column<Row>("maps_cc",
                               "Pearson's correlation of the maps of all observers, mean over sculptures and "
                               "groups",
                               "", share_decimals, [](const Row& row) { return row.maps_cc; }),
            number_column<Row>("maps_p", "How often swapping the levels within observers gives as little", "",
                               share_decimals, [](const Row& row) { return row.maps_p; }),
            number_column<Row>("maps_p_holm", holm_words, "", share_decimals,
                               [](const Row& row) { return row.maps_p_holm; }),
            similarity("cc", "Pearson's correlation", &PairRow::cc),
            similarity("sim_mit", "Similarity, maps scaled from minimum to maximum first", &PairRow::sim_mit),
            similarity("sim_pysaliency", "Similarity, maps divided by their integral only",
                       &PairRow::sim_pysaliency),
            count_column<Row>("observers", "Observers", [](const Row& row) { return row.observers; }),
            count_column<Row>("comparisons", "Of an observer on one sculpture",
                              [](const Row& row) { return row.comparisons; }),
            text_column<Row>("absent", "Why there is nothing; n/a: there is",
                             [](const Row& row) { return row.absent; }))};
}

RowLayout<TimeCourseRow> time_course_layout(const StudyResults& results) {
    using Row = TimeCourseRow;
    StudyColumns<Row> key;
    if (!results.by.empty())
        key = text_column<Row>(results.by.front(), "The level", [](const Row& row) { return row.key.value; });
    return {"time_course", "Share of the time of fixation on the head, in stretches of the presentation.",
            joined_columns<Row>(std::move(key),
                                number_column<Row>("from_s", "Begin of the stretch", "s", pixel_decimals,
                                                   [](const Row& row) { return std::optional(row.from_s); }),
                                number_column<Row>("to_s", "Its end", "s", pixel_decimals,
                                                   [](const Row& row) { return std::optional(row.to_s); }),
                                estimate_columns<Row>(
                                    "head_fraction", "Mean over observers", "", share_decimals,
                                    [](const Row& row) -> auto& { return row.head_fraction; }),
                                count_column<Row>("observers", "Observers with fixations then",
                                                  [](const Row& row) { return row.observers; }))};
}

RowLayout<QualityRow> quality_layout() {
    using Row = QualityRow;
    const auto number = [](const char* name, const char* meaning, const char* unit, auto value) {
        return number_column<Row>(name, meaning, unit, place_decimals, [value](const Row& row) {
            return std::optional<double>(value(row.quality));
        });
    };
    return {
        "quality",
        "Data quality, one row for each trial and one for each session, as Dunn et al. (2023) ask.",
        joined_columns<Row>(
            text_column<Row>("observer", "Label of the observer",
                             [](const Row& row) { return row.session.observer; }),
            text_column<Row>("session_folder", "Folder of the session",
                             [](const Row& row) { return row.session.folder; }),
            number_column<Row>("trial", "Position of the trial, from 1; n/a: of the whole session", "", 0,
                               [](const Row& row) {
                                   return row.trial ? std::optional<double>(row.trial->number) : std::nullopt;
                               }),
            number("accuracy_deg", "Mean error of the validation before it", "deg",
                   [](auto& q) { return q.accuracy_deg; }),
            number("worst_accuracy_deg", "Its largest error", "deg",
                   [](auto& q) { return q.worst_accuracy_deg; }),
            number("drift_deg", "Error at the drift check; of a session the median", "deg",
                   [](auto& q) { return q.drift_deg; }),
            number("rms_s2s_deg", "Precision: root mean square of steps between samples in fixations, median",
                   "deg", [](auto& q) { return q.rms_s2s_deg; }),
            number("sd_deg", "Precision: standard deviation in fixations, median", "deg",
                   [](auto& q) { return q.sd_deg; }),
            number("rate_hz", "Sampling rate, by the median interval of time stamps", "Hz",
                   [](auto& q) { return q.rate_hz; }),
            number("samples", "Samples of the eye", "", [](auto& q) { return q.samples; }),
            number("lost_share", "Share without gaze, blinks apart", "",
                   [](auto& q) { return q.lost_share(); }),
            number("blink_share", "Share without gaze in blinks", "",
                   [](auto& q) { return q.blink_share(); }),
            count_column<Row>("blinks", "Blinks", [](const Row& row) { return row.quality.blinks; }),
            count_column<Row>("refreshes", "Refreshes of presentations",
                              [](const Row& row) { return row.quality.refreshes; }),
            StudyColumns<Row>{{{{"missed_refreshes", "Of these missed; n/a where timing is unproven", "", {}},
                                [](auto& to, const Row& row) {
                                    const std::optional<int>& missed = row.quality.missed_refreshes;
                                    missed ? to.integer(*missed) : to.missing();
                                }}}},
            number("off_plan", "Samples that the planned times would have put on another frame", "",
                   [](auto& q) { return q.off_plan; }))};
}

} // namespace overt
