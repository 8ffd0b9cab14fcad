#include "experiment/study/tables/study_layout.h"
#include "experiment/study/tables/study_layouts.h"

namespace overt {

RowLayout<StudyMap> study_maps_layout(const StudyResults& results) {
    using Row = StudyMap;
    const auto of_made = [](double StudyMap::*what) {
        return [what](const Row& row) { return when(row.absent.empty(), row.*what); };
    };
    const auto budget = [](std::optional<double> ErrorBudget::*what) {
        return [what](const Row& row) { return row.error.*what; };
    };
    StudyLayout<Row> to("maps",
                        "One row for each map of a group on an object: by duration in ms per mm^2 and "
                        "trial, by count in fixations per mm^2 and trial.");
    to.group_and_object(results);
    to.text("weighting", "duration: fixations count with their duration; count: alike",
            [](const Row& row) { return name_of(row.weighting); });
    to.count("observers", "Observers", &Row::observers);
    to.count("trials", "Trials", &Row::trials);
    to.count("fixations", "Counted fixations", &Row::fixations);
    to.number("total", "Integral over the surface: ms, or fixations, of a trial", "", of_made(&Row::total),
              density_decimals);
    to.number("peak", "Highest density", "of that per mm^2", of_made(&Row::peak), density_decimals);
    to.number("mean", "Mean density over the whole surface", "of that per mm^2", of_made(&Row::mean),
              density_decimals);
    to.number("area_mm2", "Area of the surface", "mm^2", of_made(&Row::area_mm2), density_decimals);
    to.number("least_sigma_mm", "Narrowest kernel", "mm", of_made(&Row::least_sigma_mm), density_decimals);
    to.number("most_sigma_mm", "Widest kernel", "mm", of_made(&Row::most_sigma_mm), density_decimals);
    to.number("euclidean_leak", "Share that a Gaussian in space puts beyond three sigmas along the surface",
              "", &Row::euclidean_leak);
    to.number("accuracy_mm", "Error by the tracker's accuracy, root mean square along the surface", "mm",
              budget(&ErrorBudget::accuracy_mm));
    to.number("precision_mm", "Noise of a single sample, standard deviation by RMS-S2S", "mm",
              budget(&ErrorBudget::precision_mm));
    to.number("timing_mm", "Uncertainty of the clocks times the speed of the surface", "mm",
              budget(&ErrorBudget::timing_mm), density_decimals);
    to.number("lut_mm", "Error of the look-up of surface points", "mm", budget(&ErrorBudget::lut_mm),
              density_decimals);
    to.number("together_mm", "Root of the sum of the squares of these; n/a without an accuracy", "mm",
              budget(&ErrorBudget::together_mm));
    to.number("at_edge", "Mean share of the gaze cone beyond a depth edge, or beside the object", "",
              budget(&ErrorBudget::at_edge));
    to.number("near_edge", "Share of samples with any of their gaze cone there", "",
              budget(&ErrorBudget::near_edge));
    to.text("absent", "Why there is no map; n/a: there is one", &Row::absent);
    return to;
}

RowLayout<MapPredictionRow> map_predictions_layout(const StudyResults& results) {
    using Row = MapPredictionRow;
    StudyLayout<Row> to("map_predictions",
                        "How well a group's fixations on one object are told by maps that the same observer "
                        "did not make: means over observers, over the places that could be seen.");
    to.group_and_object(results);
    to.text(
        "predicted_by",
        "same level: other observers' fixations in the group; other level: theirs in another level of the "
        "compared column; exposure: how long, how large and how obliquely places could be seen; model: a map "
        "given "
        "by --model",
        [](const Row& row) { return name_of(row.by); });
    to.text("level",
            "Level of the compared column of the predicting map, or the model's name; x exposure: times the "
            "exposure; "
            "n/a: none",
            &Row::level);
    to.estimate("kl", "Divergence of the observer's map from the predicting one", "nat", &Row::kl);
    to.estimate("nss", "Normalised scanpath saliency", "standard deviations", &Row::nss);
    to.estimate("auc_judd", "Area under the curve after Judd", "", &Row::auc_judd);
    to.estimate("auc_borji", "Area under the curve after Borji", "", &Row::auc_borji);
    to.estimate("gain_over_exposure", "Information gain over the exposure", "bit per fixation",
                &Row::gain_over_exposure);
    to.estimate("gain_over_area", "Information gain over gaze spread evenly over what could be seen",
                "bit per fixation", &Row::gain_over_area);
    to.estimate("share_of_ceiling",
                "gain_over_area divided by that of the same level, the ceiling that other observers are", "",
                &Row::share_of_ceiling);
    to.count("observers", "Observers whose fixations were predicted", &Row::observers);
    to.count("fixations", "Counted fixations of the group", &Row::fixations);
    return to;
}

RowLayout<MapReliabilityRow> map_reliability_layout(const StudyResults& results) {
    using Row = MapReliabilityRow;
    StudyLayout<Row> to("map_reliability",
                        "How well maps would come out again with other observers: of groups, of "
                        "each level of each column, and of all.");
    to.keys(results.by, &Row::keys);
    to.object(results, &Row::object);
    to.estimate("split_half_cc",
                "Correlation of the maps of two halves of the observers that goes with the reliability", "",
                &Row::split_half_cc);
    to.estimate("reliability", "Of the map of all observers: Cronbach's alpha over the places of the surface",
                "", &Row::reliability);
    to.count("observers", "Observers with fixations there", &Row::observers);
    to.count("fixations", "Counted fixations", &Row::fixations);
    return to;
}

RowLayout<TemplateFitRow> template_fit_layout(const StudyResults& results) {
    using Row = TemplateFitRow;
    StudyLayout<Row> to("template_fit",
                        "How gaze on each object was brought to the template: lengths are the template's own "
                        "millimetres.");
    to.object(results, &Row::object, "The object");
    to.text("warp",
            "thin plate: landmarks come to lie exactly on the template's; similarity: turned, scaled and "
            "shifted, where landmarks are three or lie in a plane; the same surface: nothing was moved",
            &Row::warp);
    to.count("landmarks", "Landmarks that both have", &Row::landmarks);
    to.number("scale", "How much longer things become on the whole", "", &Row::scale);
    to.number("left_out_mm",
              "How far each landmark is brought from its own by a warp of the others: root mean square", "mm",
              &Row::left_out_mm);
    to.number("away_mm",
              "How far the warped surface lies from the template before it is laid onto it: mean over its "
              "area",
              "mm", &Row::away_mm);
    to.number("gaze_away_mm", "The same of where gaze was: mean over the counted fixations", "mm",
              &Row::gaze_away_mm);
    to.number("turned_share", "Share of its area that comes to lie on a surface that faces the other way", "",
              &Row::turned_share);
    to.count("fixations", "Counted fixations", &Row::fixations);
    return to;
}

RowLayout<ExposureRow> exposure_layout(const StudyResults& results) {
    using Row = ExposureRow;
    StudyLayout<Row> to("exposure",
                        "What one presentation shows of each area of an object: the baseline of gaze "
                        "that looks at all of the picture alike.");
    to.object(results, &Row::object, "The object");
    to.text("area", "The area; all: the whole object",
            [](const Row& row) { return row.area.empty() ? std::string("all") : row.area; });
    to.number("area_mm2", "Area", "mm^2", &Row::area_mm2);
    to.number("share_of_area", "Share of the object's area", "", &Row::share_of_area);
    to.number("never_visible", "Share of its area that no frame shows", "", &Row::never_visible);
    to.number("seconds_visible", "How long it is visible, mean over its area", "s", &Row::seconds_visible);
    to.number("share_of_exposure", "Share of the time and area of the picture that shows the object", "",
              &Row::share_of_exposure);
    to.number(
        "foreshortening",
        "Area in the picture divided by area on the surface, while it is visible: the mean cosine of the "
        "angle of view",
        "", &Row::foreshortening);
    to.number("share_of_fixations", "Share of the object's counted fixations", "", &Row::share_of_fixations);
    return to;
}

RowLayout<FactorEffectRow> factor_effects_layout() {
    using Row = FactorEffectRow;
    StudyLayout<Row> to(
        "factor_effects",
        "Whether the columns of the groups have effects on trials: permutations within observers.");
    to.text(
        "measure",
        "share on AREA: share of a trial's counted fixations on an area; log WSS: natural logarithm of its "
        "within-cluster sum of squares in mm^2",
        &Row::measure);
    to.text("effect", "A column; with a colon: the interaction of two", &Row::effect);
    to.number("statistic",
              "The largest contrast of levels, or of cells: what observers give to it, added up, over the "
              "root of the sum of "
              "squares",
              "", &Row::statistic);
    to.number("p", "How often permutations give as much", "", &Row::p);
    to.number("p_holm", "Corrected for the rows of the same measure after Holm", "", &Row::p_holm);
    to.number("least_p", "The smallest p that so many observers can give", "", &Row::least_p);
    to.count("observers", "Observers that are compared with themselves", &Row::observers);
    to.text("absent", "Why there is no test; n/a: there is one", &Row::absent);
    return to;
}

RowLayout<ReportingItem> reporting_layout() {
    using Row = ReportingItem;
    StudyLayout<Row> to("reporting",
                        "What an article on the study has to report, as far as the sessions know it.");
    to.text("topic", "Number and aspect after Holmqvist et al. (2022), table 7", &Row::topic);
    to.text("item", "What is reported", &Row::item);
    to.text("value", "As recorded or found; else what to add", &Row::value);
    to.count("recorded", "1 if it is known, else 0", &Row::is_recorded);
    return to;
}

RowLayout<GazeMotionRow> gaze_motion_layout(const StudyResults& results) {
    using Row = GazeMotionRow;
    StudyLayout<Row> to("gaze_motion",
                        "Whether gaze goes with the surface or stays on the screen while a fixation "
                        "lasts: of each level of each column, and of all.");
    to.keys(results.by, &Row::keys);
    to.estimate(
        "surface_gain",
        "Slope of gaze's way on that of the surface point looked at: 1, gaze goes with the surface; 0, it "
        "stays on the screen",
        "", &Row::surface_gain);
    to.estimate("corrected_gain", "The same with the tracker's constant error taken out", "",
                &Row::corrected_gain);
    to.estimate("surface_speed", "Mean speed of the surface points on the screen", "deg/s",
                &Row::surface_speed_deg_s);
    to.count("observers", "Observers", &Row::observers);
    to.count("fixations", "Counted fixations during which the surface moved", &Row::fixations);
    return to;
}

RowLayout<LightAtGazeRow> light_at_gaze_layout(const StudyResults& results) {
    using Row = LightAtGazeRow;
    StudyLayout<Row> to(
        "light_at_gaze",
        "Whether fixations are drawn by light: of each level of each column, and of all. Lightness "
        "is in standard deviations from its mean over the object in the same picture.");
    to.keys(results.by, &Row::keys);
    to.estimate("lightness", "Lightness of what gaze met; 0: that of the object on average", "",
                &Row::lightness);
    to.estimate(
        "over_place",
        "Lightness of what gaze met less that at the same place of the screen over the animation: above 0, "
        "gaze comes when it is bright there",
        "", &Row::over_place);
    to.estimate(
        "over_point",
        "Lightness of what gaze met less that of the same point of the surface while it is visible: above "
        "0, gaze meets the point when light falls on it, as highlights that move over the surface do",
        "", &Row::over_point);
    to.count("observers", "Observers", &Row::observers);
    to.count("fixations", "Counted fixations whose light is known", &Row::fixations);
    return to;
}

} // namespace overt
