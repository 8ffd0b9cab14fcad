#include "experiment/study/tables/area_layouts.h"

#include "experiment/study/tables/study_layout.h"

namespace overt {

namespace {

void add_figure_columns(StudyLayout<AreaRow>& to, const StudyResults& results) {
    using Row = AreaRow;
    to.text("area", "The area", &Row::area);
    to.keys(results.by, &Row::keys);
    to.estimate("by_count", "Mean over observers of their shares of fixations", "", &Row::by_count);
    to.estimate("by_duration", "The same of the time of fixation", "", &Row::by_duration);
    to.estimate("corrected",
                "The same by count with the tracker's error taken out: each observer's share under which "
                "the measured places of the fixations are most probable",
                "", &Row::corrected);
    to.number("planted",
              "Of simulated observers whose seeds are known: the share that they mean for the area", "",
              &Row::planted);
    to.number(
        "drawn",
        "Of these: the share of the places that they looked at in these very trials, which differs from "
        "the planted one by chance; what an analysis without error would find",
        "", &Row::drawn);
    to.number("pooled", "Share of all observers' fixations together, as the paper has it", "", &Row::pooled);
    to.number("pooled_low", "Lower end of Wilson's interval, as if fixations were independent", "",
              [](const Row& row) { return of_maybe(row.pooled_interval, &Interval::low); });
    to.number("pooled_high", "Its upper end", "",
              [](const Row& row) { return of_maybe(row.pooled_interval, &Interval::high); });
    to.count("observers", "Observers", &Row::observers);
    to.count("trials", "Trials", &Row::trials);
    to.count("fixations", "Counted fixations, on objects that have the area", &Row::fixations);
}

} // namespace

RowLayout<AreaRow> figure4_layout(const StudyResults& results) {
    StudyLayout<AreaRow> to("figure4_area_share", "Share of counted fixations on one area: of "
                                                  "groups, of each level of each column, and of all.");
    add_figure_columns(to, results);
    return to;
}

RowLayout<AreaRow> areas_layout(const StudyResults& results) {
    using Row = AreaRow;
    StudyLayout<Row> to("areas",
                        "What gaze does with each named area: of groups, of each level of each column, and "
                        "of all; of fixations and trials on objects that have the area.");
    add_figure_columns(to, results);
    to.number("share_of_surface", "Area as a share of the surface, mean over the fixations' objects", "",
              &Row::share_of_surface);
    to.number(
        "share_of_exposure",
        "Share of the time and solid angle that the object fills in the picture, mean over the fixations' "
        "objects: what gaze would have that is spread evenly over what is seen",
        "", &Row::share_of_exposure);
    to.estimate("over_surface", "by_count as a multiple of share_of_surface", "", &Row::over_surface);
    to.estimate("over_exposure", "by_count as a multiple of share_of_exposure", "", &Row::over_exposure);
    to.estimate("dwell_s", "Time of fixation on the area in a trial", "s", &Row::dwell_s);
    to.estimate("visits", "Visits in a trial: runs of successive fixations on the area", "", &Row::visits);
    to.estimate("visit_s", "Time of fixation of a visit", "s", &Row::visit_s);
    to.estimate("reached", "Share of trials in which the area was fixated", "", &Row::reached);
    to.estimate("first_arrival_s",
                "Time from the onset to the first fixation on the area; a trial without one counts with its "
                "whole presentation, after which nothing is known (restricted mean)",
                "s", &Row::first_arrival_s);
    to.estimate("first_arrival_number",
                "Number of that fixation among the counted ones, from 1, in trials that have one", "",
                &Row::first_arrival_number);
    to.count("looks", "Trials whose object has the area", &Row::looks);
    to.count("arrivals", "Of these, in which it was fixated", &Row::arrivals);
    return to;
}

RowLayout<SurfaceTransitionRow> surface_transitions_layout(const StudyResults& results) {
    using Row = SurfaceTransitionRow;
    StudyLayout<Row> to(
        "area_transitions",
        "Where the next fixation is, by the area of the one before: of all trials, and of each "
        "level of each column. A fixation in several areas is in the rows of each.");
    to.keys(results.by, &Row::keys);
    to.text("from", "Area of a fixation", &Row::from);
    to.text("to", "Area of the next fixation of the trial", &Row::to);
    to.estimate("probability", "Share of the fixations after one on the first area that are on the second",
                "", &Row::probability);
    to.estimate(
        "chance",
        "Share of all next fixations that are on the second: the probability if it did not matter where "
        "gaze comes from",
        "", &Row::chance);
    to.estimate("over_chance", "Difference of the two", "", &Row::over_chance);
    to.count("observers", "Observers with fixations after one on the first area", &Row::observers);
    to.count("transitions", "From the first area to the second", &Row::transitions);
    to.count("departures", "From the first area to any, itself included", &Row::departures);
    return to;
}

RowLayout<AreaPairRow> area_pairs_layout(const StudyResults& results) {
    using Row = AreaPairRow;
    StudyLayout<Row> to("area_pairs",
                        "Shares of fixations on each area, of two levels of a factor compared within "
                        "observers: means over observers of the means over their objects.");
    std::vector<std::string> others = results.by;
    std::erase(others, "object");
    to.text("area", "The area", &Row::area);
    to.keys(others, &Row::keys);
    to.text("compared", "The column whose levels are compared", &Row::column);
    to.text("a", "First level", &Row::a);
    to.text("b", "Second level", &Row::b);
    to.estimate("difference", "Share of fixations on the area, of a less that of b", "", &Row::difference);
    to.number("p", "Of flipping the signs of observers' differences, two-sided", "", &Row::p);
    to.number("p_holm",
              "The same, corrected after Holm for the rows of the area, those over all groups apart", "",
              &Row::p_holm);
    to.number("p_holm_areas", "The same, corrected for the rows of all areas of the table", "",
              &Row::p_holm_areas);
    to.evidence("", "differences", &Row::evidence);
    to.count("observers", "Observers", &Row::observers);
    to.count("comparisons", "Of an observer on one object", &Row::comparisons);
    return to;
}

} // namespace overt
