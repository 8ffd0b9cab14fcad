#include "experiment/study/tables/study_layouts.h"

#include <fmt/format.h>

#include "experiment/record/tables/joined_cells.h"
#include "experiment/study/tables/study_layout.h"

namespace overt {

namespace {

/// Columns of `--by` that the own ones do not have.
std::vector<std::string> others_of(const std::vector<std::string>& by,
                                   std::initializer_list<const char*> own) {
    std::vector<std::string> others;
    std::ranges::copy_if(by, std::back_inserter(others), [&](const std::string& column) {
        return std::ranges::find(own, column) == own.end();
    });
    return others;
}

/// Observer, trial, and the usual factors, of anything that is of a trial.
template <class Row> void add_trial(StudyLayout<Row>& to, const StudyResults& results) {
    const auto factor = [](const std::string& column) {
        return [column](const Row& row) { return row.trial.key(column); };
    };
    to.text("observer", "Label of the observer", factor("observer"));
    to.text("session_folder", "Folder of the session",
            [&results](const Row& row) { return item(results.sessions, row.trial.session).folder; });
    to.count("trial", "Position of the trial in the observer's order, from 1",
             [](const Row& row) { return row.trial.number; });
    to.text("task", "Which question was asked", factor("task"));
    to.text("object", "Which object was shown", factor("object"));
    to.text("material", "In which material it was shown", factor("material"));
    for (const std::string& column :
         others_of(results.by, {"observer", "session_folder", "trial", "task", "object", "material"}))
        to.text(column, "As in the table of trials", factor(column));
}

std::string part_name(const StudyObject& object, const std::optional<PartIndex>& part) {
    return part && *part < object.part_names.size() ? object.part_names[*part] : std::string();
}

auto of_fixation(auto what) {
    return [what](const FixationRow& row) { return std::invoke(what, row.fixation); };
}

/// n/a of a fixation whose session knows of no stimulus.
auto of_shown(auto what) {
    return [what](const FixationRow& row) {
        return when(row.fixation.why != NotCounted::no_stimulus, std::invoke(what, row.fixation));
    };
}

/// Of the area of figure 4.
auto of_evidence(const StudyResults& results, double AreaEvidence::*which) {
    return [&results, which](const FixationRow& row) -> std::optional<double> {
        const std::vector<AreaEvidence>& evidence = row.fixation.evidence;
        const auto area = item(results.objects, row.trial.object).areas.find(results.area);
        if (!area || *area >= evidence.size() || !evidence[*area].tells())
            return std::nullopt;
        return evidence[*area].*which;
    };
}

auto of_cluster(auto what) {
    return [what](const ClusterRow& row) { return of_maybe(row.cluster, what); };
}

auto of_difference(auto what) {
    return [what](const ClusterRow& row) { return std::invoke(what, row.map); };
}

/// Of maps that there are.
auto of_tested(double DifferenceMap::*what) {
    return [what](const ClusterRow& row) { return when(row.map.absent.empty(), row.map.*what); };
}

auto of_quality(auto what) {
    return [what](const QualityRow& row) { return std::invoke(what, row.quality); };
}

} // namespace

RowLayout<FixationRow> study_fixations_layout(const StudyResults& results) {
    using Fixation = StudyFixation;
    const auto axis = [&results](int which) {
        return [&results, which](const FixationRow& row) {
            const auto& mm = item(results.objects, row.trial.object).mm_per_unit;
            return row.fixation.part && mm ? std::optional(row.fixation.position[which] * *mm) : std::nullopt;
        };
    };
    StudyLayout<FixationRow> to(
        "fixations",
        "One row for each fixation of the trials that count, re-projected sample by sample through "
        "the frames lit meanwhile.");
    add_trial(to, results);
    to.number("onset_s", "Begin since the presentation's onset", "s", of_fixation(&Fixation::onset_s));
    to.number("duration_s", "Duration, cut at the presentation's end", "s",
              of_fixation(&Fixation::duration_s));
    to.number("x_px", "Mean place on the screen, from the left", "px",
              of_fixation([](auto& fixation) { return fixation.place.x_px; }), pixel_decimals);
    to.number("y_px", "Mean place on the screen, from the top", "px",
              of_fixation([](auto& fixation) { return fixation.place.y_px; }), pixel_decimals);
    to.count("counted", "1 if it is counted in the results, else 0", of_fixation(&Fixation::counted));
    to.text("why", "counted, or why not", of_fixation([](auto& fixation) { return name_of(fixation.why); }));
    to.count("samples", "Samples with gaze while a frame was lit; where no stimulus is known, all with gaze",
             of_fixation(&Fixation::samples));
    to.number("on_surface", "Share of these that met the object", "", of_shown(&Fixation::on_surface));
    to.number("within_reach", "Share that missed it by no more than the reach, placed at its outline", "",
              of_shown(&Fixation::within_reach));
    to.count("only_by_reach", "1 if it is counted and would not be without the reach, else 0",
             of_fixation(&Fixation::only_by_reach));
    to.text("part", "The part with most of both: the areas that it belongs to, the largest first",
            [&results](const FixationRow& row) {
                return part_name(item(results.objects, row.trial.object), row.fixation.part);
            });
    to.number("x_mm", "Place on the surface of the unturned object", "mm", axis(0));
    to.number("y_mm", "The same, y", "mm", axis(1));
    to.number("z_mm", "The same, z, upwards", "mm", axis(2));
    to.number("spread_mm", "Root mean square distance of its samples from that place", "mm",
              of_fixation(&Fixation::spread_mm));
    to.number("spread_deg", "The same, as the observer sees it", "deg", of_fixation(&Fixation::spread_deg));
    to.number("cone_at_edge", "Share of the tracker's gaze cone beside the object, or on another sheet of it",
              "", of_fixation(&Fixation::cone_at_edge));
    if (!results.area.empty()) {
        to.number("evidence_inside",
                  fmt::format(
                      "How probable its place is, per square pixel and with the tracker's error, if the area "
                      "{} was looked at; n/a: the error is not known",
                      results.area),
                  "1/px^2", of_evidence(results, &AreaEvidence::inside), density_decimals);
        to.number("evidence_elsewhere", "The same if another place of the object was", "1/px^2",
                  of_evidence(results, &AreaEvidence::elsewhere), density_decimals);
    }
    to.number("angle_deg", "Turn of the object halfway through", "deg", of_shown(&Fixation::mid_angle_deg),
              pixel_decimals);
    return to;
}

RowLayout<TrialSummaryRow> study_trials_layout(const StudyResults& results) {
    using Row = TrialSummaryRow;
    StudyLayout<Row> to(
        "trials", "One row for each trial that came to its end, with what its counted fixations come to.");
    add_trial(to, results);
    to.count("excluded", "1 if a rule excludes it, else 0",
             [](const Row& row) { return row.trial.excluded; });
    to.text("why_excluded", "The rule; n/a: not excluded",
            [](const Row& row) { return row.trial.why_excluded; });
    to.number("presentation_s", "Duration of the presentation", "s",
              [](const Row& row) { return row.trial.presentation_s; });
    to.count("fixations", "Counted fixations", &Row::counted);
    to.number("fixated_s", "Time of counted fixations", "s", &Row::counted_s);
    for (std::size_t area = 0; area < results.areas.size(); ++area) {
        const std::string& name = results.areas[area];
        to.count("on_" + name,
                 fmt::format("Counted fixations on the area {}; n/a: the object has none", name),
                 [area](const Row& row) { return of_maybe(row.areas[area], &Row::OnArea::fixations); });
        to.number(name + "_s", "Time of these", "s",
                  [area](const Row& row) { return of_maybe(row.areas[area], &Row::OnArea::seconds); });
    }
    to.number("wss_mm2", "Mean within-cluster sum of squares of these, two at least, divided by N - 1",
              "mm^2", &Row::wss_mm2);
    return to;
}

RowLayout<DistributionRow> distributions_layout(const StudyResults& results) {
    using Row = DistributionRow;
    StudyLayout<Row> to(
        "figure5_distribution",
        "How the fixations of a group scatter on one object; those of all observers together.");
    to.group_and_object(results);
    to.estimate("wss_mm2", "Mean within-cluster sum of squares: the sum of the three variances", "mm^2",
                &Row::wss_mm2);
    to.estimate("wss_deg2", "The same in degrees at the depth of the axis", "deg^2", &Row::wss_deg2);
    to.number("planted_wss_mm2", "Of simulated observers: the same of the places that they mean to look at",
              "mm^2", &Row::planted_wss_mm2);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::string name{"xyz"[axis]};
        to.number("var_" + name + "_mm2", "Variance of " + name + ", divided by N", "mm^2",
                  [axis](const Row& row) { return row.variance_mm2[axis]; });
        to.number("var_" + name + "_deg2", "The same", "deg^2",
                  [axis](const Row& row) { return row.variance_deg2[axis]; });
    }
    to.number("map_peak", "Highest density of the map by duration, of a trial", "ms/mm^2", &Row::map_peak,
              density_decimals);
    to.number("map_mean", "Its mean over the surface", "ms/mm^2", &Row::map_mean, density_decimals);
    to.count("observers", "Observers", &Row::observers);
    to.count("fixations", "Counted fixations", &Row::fixations);
    return to;
}

RowLayout<PairRow> pairs_layout(const StudyResults& results) {
    using Row = PairRow;
    const char* const holm_words =
        "The same, corrected after Holm for the rows of the table, those over all groups apart";
    StudyLayout<Row> to("table1_pairs",
                        "Two levels of a factor compared within observers: means over observers of "
                        "the means over their objects.");
    to.keys(others_of(results.by, {"object"}), &Row::keys);
    to.text("compared", "The column whose levels are compared", &Row::column);
    to.text("a", "First level", &Row::a);
    to.text("b", "Second level", &Row::b);
    to.estimate("wss_difference_mm2", "WSS of a less that of b, both divided by N - 1", "mm^2",
                &Row::wss_difference_mm2);
    to.estimate("wss_difference_deg2", "The same", "deg^2", &Row::wss_difference_deg2);
    to.number("wss_p", "Of flipping the signs of observers' differences, two-sided", "", &Row::wss_p);
    to.number("wss_p_holm", holm_words, "", &Row::wss_p_holm);
    to.evidence("wss_", "differences of WSS in deg^2", &Row::wss_evidence);
    to.number("maps_cc", "Pearson's correlation of the maps of all observers, mean over objects and groups",
              "", &Row::maps_cc);
    to.number("maps_p", "How often swapping the levels within observers gives as little", "", &Row::maps_p);
    to.number("maps_p_holm", holm_words, "", &Row::maps_p_holm);
    const auto similarity = [&to](const std::string& name, const std::string& what, auto member) {
        const auto part = [member](Estimate SimilarityEstimate::*which) {
            return [member, which](const Row& row) { return row.*member.*which; };
        };
        to.estimate(name, what + " of both maps, mean over observers", "", part(&SimilarityEstimate::value));
        to.estimate(name + "_other_level",
                    "The same of maps of two observers who saw different levels, all of as many fixations of "
                    "either level: mean over pairs",
                    "", part(&SimilarityEstimate::other_level));
        to.estimate(name + "_same_level",
                    "The same of two observers who saw the same level: the ceiling of " + name +
                        "_other_level",
                    "", part(&SimilarityEstimate::same_level));
        to.estimate(name + "_level_effect", "The latter less the former: 0 where levels make no difference",
                    "", part(&SimilarityEstimate::level_effect));
        to.estimate(name + "_null", "Of whole trials, dealt out again over the levels within observers", "",
                    part(&SimilarityEstimate::null));
        to.number(name + "_p", "How often dealing out gives as little; n/a where each level was one trial",
                  "", [member](const Row& row) { return (row.*member).p; });
    };
    similarity("cc", "Pearson's correlation", &Row::cc);
    similarity("sim_mit", "Similarity, maps scaled from minimum to maximum first", &Row::sim_mit);
    similarity("sim_pysaliency", "Similarity, maps divided by their integral only", &Row::sim_pysaliency);
    to.count("observers", "Observers", &Row::observers);
    to.count("comparisons", "Of an observer on one object", &Row::comparisons);
    to.text("absent", "Why there is nothing; n/a: there is", &Row::absent);
    return to;
}

namespace {

RowLayout<ClusterRow> cluster_columns(const StudyResults& results, StudyLayout<ClusterRow> to,
                                      const std::vector<std::string>& keys, const char* compared) {
    using Cluster = DifferenceMap::Cluster;
    const auto centroid = [](int axis) {
        return of_cluster([axis](const Cluster& cluster) { return cluster.centroid_mm[axis]; });
    };
    to.keys(keys, of_difference(&DifferenceMap::keys));
    to.object(results, of_difference(&DifferenceMap::object), "The object");
    to.text("compared", compared, of_difference(&DifferenceMap::column));
    to.text("a", "First level", of_difference(&DifferenceMap::a));
    to.text("b", "Second level", of_difference(&DifferenceMap::b));
    to.count("observers", "Observers", of_difference(&DifferenceMap::observers));
    to.number("threshold_t", "t beyond which a vertex belongs to a cluster", "",
              of_tested(&DifferenceMap::threshold_t));
    to.count("cluster", "Number of the cluster, the largest first; 0: there is none", &ClusterRow::number);
    to.number("mass", "Sum of t times area", "mm^2", of_cluster(&Cluster::mass));
    to.number("area_mm2", "Area", "mm^2", of_cluster(&Cluster::area_mm2));
    to.number("difference", "Share of the time of fixation that a has there more than b, mean", "",
              of_cluster(&Cluster::difference));
    to.number("x_mm", "Centre of the difference within the cluster, on the unturned object", "mm",
              centroid(0));
    to.number("y_mm", "The same, y", "mm", centroid(1));
    to.number("z_mm", "The same, z, upwards", "mm", centroid(2));
    to.text("part", "The part with most of the difference within the cluster",
            [&results](const ClusterRow& row) {
                return row.cluster ? part_name(item(results.objects, row.map.object), row.cluster->part) : "";
            });
    to.number("p", "Corrected over the surface", "", of_cluster(&Cluster::p));
    to.number("p_of_all", "Corrected over all maps of this table, too: of the largest cluster of any", "",
              of_cluster(&Cluster::p_of_all));
    to.number("least_p", "The smallest p that so many observers can give", "",
              of_tested(&DifferenceMap::least_p));
    to.number(
        "tfce_p",
        "Without a threshold (threshold-free cluster enhancement), corrected over the surface: the least "
        "within the cluster; n/a: it was not asked for (--tfce)",
        "", [](const ClusterRow& row) { return row.cluster ? row.cluster->free_p : std::nullopt; });
    to.number("tfce_least_p", "The least of it anywhere on the surface", "",
              of_difference(&DifferenceMap::free_least_p));
    to.number("tfce_area_mm2", "Area of where it is at most 1 less the level of intervals", "mm^2",
              of_difference(&DifferenceMap::free_area_mm2));
    to.text("absent", "Why there is no map; n/a: there is one", of_difference(&DifferenceMap::absent));
    return to;
}

} // namespace

RowLayout<ClusterRow> clusters_layout(const StudyResults& results) {
    return cluster_columns(results,
                           {"difference_clusters",
                            "Clusters of vertices where two levels differ within observers, corrected over "
                            "the surface by the largest cluster of permutations."},
                           others_of(results.by, {"object"}), "The column whose levels are compared");
}

RowLayout<ClusterRow> answer_clusters_layout(const StudyResults& results) {
    return cluster_columns(
        results,
        {"answer_map_clusters",
         "Clusters of vertices at which gaze before one answer differs from gaze before another within "
         "observers, corrected over the surface by the largest cluster of permutations."},
        {"task"},
        "The answer; its choices are a and b, or, where these are slots, the stimuli that were "
        "chosen and the others");
}

RowLayout<TimeCourseRow> time_course_layout(const StudyResults& results) {
    using Row = TimeCourseRow;
    StudyLayout<Row> to("time_course",
                        "Share of the time of fixation on each area, in stretches of the presentation.");
    to.text("area", "The area", &Row::area);
    if (!results.by.empty())
        to.text(results.by.front(), "The level", [](const Row& row) { return row.key.value; });
    to.number("from_s", "Begin of the stretch", "s", &Row::from_s, pixel_decimals);
    to.number("to_s", "Its end", "s", &Row::to_s, pixel_decimals);
    to.estimate("share", "Mean over observers", "", &Row::share);
    to.count("observers", "Observers with fixations then", &Row::observers);
    return to;
}

RowLayout<QualityRow> quality_layout() {
    using Quality = StudyQuality;
    StudyLayout<QualityRow> to(
        "quality",
        "Data quality, one row for each trial and one for each session, as Dunn et al. (2023) ask.");
    to.text("observer", "Label of the observer", [](const QualityRow& row) { return row.session.observer; });
    to.text("session_folder", "Folder of the session",
            [](const QualityRow& row) { return row.session.folder; });
    to.count("trial", "Position of the trial, from 1; n/a: of the whole session",
             [](const QualityRow& row) { return of_maybe(row.trial, &StudyTrial::number); });
    to.number("accuracy_deg", "Mean error of the validation before it", "deg",
              of_quality(&Quality::accuracy_deg));
    to.number("worst_accuracy_deg", "Its largest error", "deg", of_quality(&Quality::worst_accuracy_deg));
    to.number("drift_deg", "Error at the drift check; of a session the median", "deg",
              of_quality(&Quality::drift_deg));
    to.number("rms_s2s_deg", "Precision: root mean square of steps between samples in fixations, median",
              "deg", of_quality(&Quality::rms_s2s_deg));
    to.number("sd_deg",
              "Precision: standard deviation in fixations, median; around the motion of the eye, a line "
              "through each 0.2 s, so that following a turning object is not taken for noise",
              "deg", of_quality(&Quality::sd_deg));
    to.number("rate_hz", "Sampling rate, by the median interval of time stamps", "Hz",
              of_quality(&Quality::rate_hz));
    to.number("samples", "Samples of the eye", "", of_quality(&Quality::samples));
    to.number("lost_share", "Share without gaze, blinks apart", "", of_quality(&Quality::lost_share));
    to.number("blink_share", "Share without gaze in blinks", "", of_quality(&Quality::blink_share));
    to.count("blinks", "Blinks", of_quality(&Quality::blinks));
    to.count("refreshes", "Refreshes of presentations", of_quality(&Quality::refreshes));
    to.count("missed_refreshes", "Of these missed; n/a where timing is unproven",
             of_quality(&Quality::missed_refreshes));
    to.number("off_plan", "Samples that the planned times would have put on another frame", "",
              of_quality(&Quality::off_plan));
    return to;
}

} // namespace overt
