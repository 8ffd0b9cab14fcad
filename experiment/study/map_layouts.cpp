#include "experiment/study/layout_parts.h"
#include "experiment/study/study_layouts.h"

namespace overt {

RowLayout<StudyMap> study_maps_layout(const StudyResults& results) {
    using Row = StudyMap;
    const auto number = [](const char* name, const char* meaning, const char* unit, auto member) {
        return number_column<Row>(name, meaning, unit, density_decimals, [member](const Row& row) {
            return row.absent.empty() ? std::optional<double>(row.*member) : std::nullopt;
        });
    };
    const auto budget = [](const char* name, const char* meaning, const char* unit, int decimals,
                           auto member) {
        return number_column<Row>(name, meaning, unit, decimals,
                                  [member](const Row& row) { return row.error.*member; });
    };
    return {
        "maps",
        "One row for each map of a group on a sculpture: by duration in ms per mm^2 and trial, by count in "
        "fixations per mm^2 and trial.",
        joined_columns<Row>(
            group_columns<Row>(results),
            text_column<Row>("weighting", "duration: fixations count with their duration; count: alike",
                             [](const Row& row) { return name_of(row.weighting); }),
            count_column<Row>("observers", "Observers", [](const Row& row) { return row.observers; }),
            count_column<Row>("trials", "Trials", [](const Row& row) { return row.trials; }),
            count_column<Row>("fixations", "Counted fixations", [](const Row& row) { return row.fixations; }),
            number("total", "Integral over the surface: ms, or fixations, of a trial", "", &StudyMap::total),
            number("peak", "Highest density", "1/mm^2 of that", &StudyMap::peak),
            number("mean", "Mean density over the whole surface", "1/mm^2 of that", &StudyMap::mean),
            number("area_mm2", "Area of the surface", "mm^2", &StudyMap::area_mm2),
            number("least_sigma_mm", "Narrowest kernel", "mm", &StudyMap::least_sigma_mm),
            number("most_sigma_mm", "Widest kernel", "mm", &StudyMap::most_sigma_mm),
            number_column<Row>("euclidean_leak",
                               "Share that a Gaussian in space puts beyond three sigmas along the surface",
                               "", share_decimals, [](const Row& row) { return row.euclidean_leak; }),
            budget("accuracy_mm", "Error by the tracker's accuracy, root mean square along the surface", "mm",
                   place_decimals, &ErrorBudget::accuracy_mm),
            budget("precision_mm", "Noise of a single sample, standard deviation by RMS-S2S", "mm",
                   place_decimals, &ErrorBudget::precision_mm),
            budget("timing_mm", "Uncertainty of the clocks times the speed of the surface", "mm",
                   density_decimals, &ErrorBudget::timing_mm),
            budget("lut_mm", "Error of the look-up of surface points", "mm", density_decimals,
                   &ErrorBudget::lut_mm),
            budget("together_mm", "Root of the sum of the squares of these; n/a without an accuracy", "mm",
                   place_decimals, &ErrorBudget::together_mm),
            budget("at_edge", "Mean share of the gaze cone beyond a depth edge, or beside the sculpture", "",
                   share_decimals, &ErrorBudget::at_edge),
            budget("near_edge", "Share of samples with any of their gaze cone there", "", share_decimals,
                   &ErrorBudget::near_edge),
            text_column<Row>("absent", "Why there is no map; n/a: there is one",
                             [](const Row& row) { return row.absent; }))};
}

RowLayout<MapPredictionRow> map_predictions_layout(const StudyResults& results) {
    using Row = MapPredictionRow;
    const auto estimate = [](const char* name, const char* meaning, const char* unit, auto member) {
        return estimate_columns<Row>(
            name, meaning, unit, share_decimals, [member](const Row& row) -> auto& { return row.*member; });
    };
    return {
        "map_predictions",
        "How well a group's fixations on one sculpture are told by maps that the same observer did not make: "
        "means over observers, over the places that could be seen.",
        joined_columns<Row>(
            group_columns<Row>(results),
            text_column<Row>(
                "predicted_by",
                "same level: other observers' fixations in the group; other level: theirs in another level "
                "of "
                "the compared column; exposure: how long, how large and how obliquely places could be seen",
                [](const Row& row) { return name_of(row.by); }),
            text_column<Row>("level", "Level of the compared column of the predicting map; n/a: none",
                             [](const Row& row) { return row.level; }),
            estimate("kl", "Divergence of the observer's map from the predicting one", "nat", &Row::kl),
            estimate("nss", "Normalised scanpath saliency", "standard deviations", &Row::nss),
            estimate("auc_judd", "Area under the curve after Judd", "", &Row::auc_judd),
            estimate("auc_borji", "Area under the curve after Borji", "", &Row::auc_borji),
            estimate("gain_over_exposure", "Information gain over the exposure", "bit per fixation",
                     &Row::gain_over_exposure),
            estimate("gain_over_area", "Information gain over gaze spread evenly over what could be seen",
                     "bit per fixation", &Row::gain_over_area),
            count_column<Row>("observers", "Observers whose fixations were predicted",
                              [](const Row& row) { return row.observers; }),
            count_column<Row>("fixations", "Counted fixations of the group",
                              [](const Row& row) { return row.fixations; }))};
}

RowLayout<MapReliabilityRow> map_reliability_layout(const StudyResults& results) {
    using Row = MapReliabilityRow;
    return {
        "map_reliability",
        "How well maps would come out again with other observers: of groups, of each level of each column, "
        "and "
        "of all.",
        joined_columns<Row>(
            key_columns<Row>(
                results.by, [](const Row& row) -> auto& { return row.keys; }),
            text_column<Row>("on_sculpture", "The sculpture on whose surface this is",
                             [&results](const Row& row) { return of(results.sculptures, row.sculpture).id; }),
            estimate_columns<Row>(
                "split_half_cc", "Correlation of the maps of random halves of the observers, mean", "",
                share_decimals, [](const Row& row) -> auto& { return row.split_half_cc; }),
            estimate_columns<Row>(
                "reliability", "The same for all observers, after Spearman and Brown", "", share_decimals,
                [](const Row& row) -> auto& { return row.reliability; }),
            count_column<Row>("observers", "Observers with fixations there",
                              [](const Row& row) { return row.observers; }),
            count_column<Row>("fixations", "Counted fixations",
                              [](const Row& row) { return row.fixations; }))};
}

RowLayout<ExposureRow> exposure_layout(const StudyResults& results) {
    using Row = ExposureRow;
    const auto number = [](const char* name, const char* meaning, const char* unit, auto member) {
        return number_column<Row>(name, meaning, unit, share_decimals,
                                  [member](const Row& row) { return std::optional<double>(row.*member); });
    };
    return {
        "exposure",
        "What one presentation shows of each part of a sculpture: the baseline of gaze that looks at all "
        "of the picture alike.",
        joined_columns<Row>(
            text_column<Row>("on_sculpture", "The sculpture",
                             [&results](const Row& row) { return of(results.sculptures, row.sculpture).id; }),
            text_column<Row>("part", "The part; all: the whole sculpture",
                             [](const Row& row) { return row.part; }),
            number("area_mm2", "Area", "mm^2", &Row::area_mm2),
            number("share_of_area", "Share of the sculpture's area", "", &Row::share_of_area),
            number("never_visible", "Share of the part's area that no frame shows", "", &Row::never_visible),
            number("seconds_visible", "How long it is visible, mean over its area", "s",
                   &Row::seconds_visible),
            number("share_of_exposure", "Share of the time and area of the picture that shows the sculpture",
                   "", &Row::share_of_exposure),
            number_column<Row>("foreshortening",
                               "Area in the picture divided by area on the surface, while it is visible: "
                               "the mean cosine of the angle of view",
                               "", share_decimals, [](const Row& row) { return row.foreshortening; }),
            number_column<Row>("share_of_fixations", "Share of the sculpture's counted fixations", "",
                               share_decimals, [](const Row& row) { return row.share_of_fixations; }))};
}

RowLayout<FactorEffectRow> factor_effects_layout(const StudyResults&) {
    using Row = FactorEffectRow;
    return {
        "factor_effects",
        "Whether the columns of the groups have effects on trials: permutations within observers.",
        joined_columns<Row>(
            text_column<Row>(
                "measure",
                "head fraction: share of a trial's counted fixations on the head; log WSS: natural "
                "logarithm of its within-cluster sum of squares in mm^2",
                [](const Row& row) { return row.measure; }),
            text_column<Row>("effect", "A column; with a colon: the interaction of two",
                             [](const Row& row) { return row.effect; }),
            number_column<Row>(
                "statistic",
                "Of a column: the sum over levels of the squares of the means over observers, times their "
                "number; of an interaction: the sum over cells of the squares of the means",
                "", share_decimals, [](const Row& row) { return row.statistic; }),
            number_column<Row>("p", "How often permutations give as much", "", share_decimals,
                               [](const Row& row) { return row.p; }),
            number_column<Row>("p_holm", "Corrected for the rows of the same measure after Holm", "",
                               share_decimals, [](const Row& row) { return row.p_holm; }),
            number_column<Row>("least_p", "The smallest p that so many observers can give", "",
                               share_decimals, [](const Row& row) { return row.least_p; }),
            count_column<Row>("observers", "Observers that are compared with themselves",
                              [](const Row& row) { return row.observers; }),
            text_column<Row>("absent", "Why there is no test; n/a: there is one",
                             [](const Row& row) { return row.absent; }))};
}

RowLayout<ReportingItem> reporting_layout() {
    using Row = ReportingItem;
    return {"reporting", "What an article on the study has to report, as far as the sessions know it.",
            joined_columns<Row>(
                text_column<Row>("topic", "Number and aspect after Holmqvist et al. (2022), table 7",
                                 [](const Row& row) { return row.topic; }),
                text_column<Row>("item", "What is reported", [](const Row& row) { return row.item; }),
                text_column<Row>("value", "As recorded or found; else what to add",
                                 [](const Row& row) { return row.value; }),
                count_column<Row>("recorded", "1 if it is known, else 0",
                                  [](const Row& row) { return row.is_recorded ? 1 : 0; }))};
}

RowLayout<GazeMotionRow> gaze_motion_layout(const StudyResults& results) {
    using Row = GazeMotionRow;
    return {"gaze_motion",
            "Whether gaze goes with the surface or stays on the screen while a fixation lasts: of each level "
            "of each "
            "column, and of all.",
            joined_columns<Row>(
                key_columns<Row>(
                    results.by, [](const Row& row) -> auto& { return row.keys; }),
                estimate_columns<Row>(
                    "surface_gain",
                    "Slope of gaze's way on that of the surface point looked at: 1, gaze goes with the "
                    "surface; 0, it "
                    "stays on the screen",
                    "", share_decimals, [](const Row& row) -> auto& { return row.surface_gain; }),
                estimate_columns<Row>(
                    "surface_speed", "Mean speed of the surface points on the screen", "deg/s",
                    share_decimals, [](const Row& row) -> auto& { return row.surface_speed_deg_s; }),
                count_column<Row>("observers", "Observers", [](const Row& row) { return row.observers; }),
                count_column<Row>("fixations", "Counted fixations during which the surface moved",
                                  [](const Row& row) { return row.fixations; }))};
}

RowLayout<LightAtGazeRow> light_at_gaze_layout(const StudyResults& results) {
    using Row = LightAtGazeRow;
    return {
        "light_at_gaze",
        "Whether fixations are drawn by light: of each level of each column, and of all. Lightness is in "
        "standard deviations from its mean over the object in the same picture.",
        joined_columns<Row>(
            key_columns<Row>(
                results.by, [](const Row& row) -> auto& { return row.keys; }),
            estimate_columns<Row>(
                "lightness", "Lightness of what gaze met; 0: that of the object on average", "",
                share_decimals, [](const Row& row) -> auto& { return row.lightness; }),
            estimate_columns<Row>(
                "over_place",
                "Lightness of what gaze met less that at the same place of the screen over the animation: "
                "above 0, gaze comes when it is bright there",
                "", share_decimals, [](const Row& row) -> auto& { return row.over_place; }),
            estimate_columns<Row>(
                "over_point",
                "Lightness of what gaze met less that of the same point of the surface while it is "
                "visible: above 0, gaze meets the point when light falls on it, as highlights that move "
                "over the surface do",
                "", share_decimals, [](const Row& row) -> auto& { return row.over_point; }),
            count_column<Row>("observers", "Observers", [](const Row& row) { return row.observers; }),
            count_column<Row>("fixations", "Counted fixations whose light is known",
                              [](const Row& row) { return row.fixations; }))};
}

RowLayout<ClusterRow> clusters_layout(const StudyResults& results) {
    using Row = ClusterRow;
    const auto of_cluster = [](const char* name, const char* meaning, const char* unit, auto member) {
        return number_column<Row>(name, meaning, unit, place_decimals, [member](const Row& row) {
            return row.cluster ? std::optional<double>(row.cluster->*member) : std::nullopt;
        });
    };
    const auto centroid = [](const char* name, const char* meaning, int axis) {
        return number_column<Row>(name, meaning, "mm", place_decimals, [axis](const Row& row) {
            return row.cluster ? std::optional<double>(row.cluster->centroid_mm[axis]) : std::nullopt;
        });
    };
    return {
        "difference_clusters",
        "Clusters of vertices where two levels differ within observers, corrected over the surface by the "
        "largest cluster of permutations.",
        joined_columns<Row>(
            key_columns<Row>(
                others_of(results.by, {"sculpture"}), [](const Row& row) -> auto& { return row.map.keys; }),
            text_column<Row>(
                "on_sculpture", "The sculpture",
                [&results](const Row& row) { return of(results.sculptures, row.map.sculpture).id; }),
            text_column<Row>("compared", "The column whose levels are compared",
                             [](const Row& row) { return row.map.column; }),
            text_column<Row>("a", "First level", [](const Row& row) { return row.map.a; }),
            text_column<Row>("b", "Second level", [](const Row& row) { return row.map.b; }),
            count_column<Row>("observers", "Observers", [](const Row& row) { return row.map.observers; }),
            number_column<Row>(
                "threshold_t", "t beyond which a vertex belongs to a cluster", "", share_decimals,
                [](const Row& row) {
                    return row.map.absent.empty() ? std::optional(row.map.threshold_t) : std::nullopt;
                }),
            count_column<Row>("cluster", "Number of the cluster, the largest first; 0: there is none",
                              [](const Row& row) { return row.number; }),
            of_cluster("mass", "Sum of t times area", "mm^2", &DifferenceMap::Cluster::mass),
            of_cluster("area_mm2", "Area", "mm^2", &DifferenceMap::Cluster::area_mm2),
            of_cluster("difference", "Share of the time of fixation that a has there more than b, mean", "",
                       &DifferenceMap::Cluster::difference),
            centroid("x_mm", "Centre of the difference within the cluster, object coordinates in apparent mm",
                     0),
            centroid("y_mm", "The same, y", 1), centroid("z_mm", "The same, z, upwards", 2),
            text_column<Row>("part", "The part with most of the difference within the cluster",
                             [&results](const Row& row) -> std::string {
                                 const auto& names = of(results.sculptures, row.map.sculpture).part_names;
                                 return row.cluster && row.cluster->part && *row.cluster->part < names.size()
                                            ? names[*row.cluster->part]
                                            : std::string();
                             }),
            of_cluster("p", "Corrected over the surface", "", &DifferenceMap::Cluster::p),
            of_cluster("p_of_all", "Corrected over all maps of this table, too (Bonferroni)", "",
                       &DifferenceMap::Cluster::p_of_all),
            number_column<Row>(
                "least_p", "The smallest p that so many observers can give", "", share_decimals,
                [](const Row& row) {
                    return row.map.absent.empty() ? std::optional(row.map.least_p) : std::nullopt;
                }),
            text_column<Row>("absent", "Why there is no map; n/a: there is one",
                             [](const Row& row) { return row.map.absent; }))};
}

} // namespace overt
