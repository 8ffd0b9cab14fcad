#include "experiment/study/tables/looking_layouts.h"

#include <algorithm>

#include "experiment/study/tables/study_layout.h"

namespace overt {

namespace {

/// What rows of two levels have.
template <class Row> void add_levels(StudyLayout<Row>& to) {
    to.text("compared", "The column whose levels are compared", &Row::column);
    to.text("a", "First level", &Row::a);
    to.text("b", "Second level", &Row::b);
}

/// Of a row that has a cluster.
auto of_time_cluster(auto what) {
    return [what](const TimeClusterRow& row) { return when(row.number > 0, std::invoke(what, row)); };
}

} // namespace

RowLayout<MeasureDifferenceRow> measure_differences_layout() {
    using Row = MeasureDifferenceRow;
    StudyLayout<Row> to(
        "measure_differences",
        "Two levels of a factor compared within observers by what their trials come to, measure by "
        "measure: means over observers of the means over their objects, all else alike.");
    to.text("measure",
            "As the table of levels calls it: dwell_s, visits, visit_s, reached, first_arrival_s of areas; "
            "transition "
            "(probability in area_transitions); surface_gain, corrected_gain (gaze_motion); lightness, "
            "over_place, "
            "over_point (light_at_gaze); the others: scanpaths",
            &Row::measure);
    to.text("of", "The area, or two: from > to; n/a: of all of the object", &Row::of);
    to.text("unit", "Of the difference; n/a: none", &Row::unit);
    add_levels(to);
    to.estimate("difference", "The measure in a less that in b", "", &Row::difference);
    to.number("p", "Of flipping the signs of observers' differences, two-sided", "", &Row::p);
    to.number("p_holm", "The same, corrected after Holm for the rows of the measure", "", &Row::p_holm);
    to.evidence("", "differences", &Row::evidence);
    to.count("observers", "Observers", &Row::observers);
    to.count("comparisons", "Of an observer on one object, all else alike", &Row::comparisons);
    return to;
}

RowLayout<TimeClusterRow> time_clusters_layout() {
    using Row = TimeClusterRow;
    StudyLayout<Row> to(
        "time_clusters",
        "When two levels differ within observers in the share of the time of fixation on an area: clusters "
        "of "
        "successive stretches of the presentation, corrected by the largest cluster of permutations.");
    to.text("area", "The area", &Row::area);
    add_levels(to);
    to.count("observers", "Observers", &Row::observers);
    to.number("threshold_t", "t beyond which a stretch belongs to a cluster", "",
              [](const Row& row) { return when(row.absent.empty(), row.threshold_t); });
    to.count("cluster", "Number of the cluster, the largest first; 0: there is none", &Row::number);
    to.number("from_s", "Its begin, since the onset", "s", of_time_cluster(&Row::from_s));
    to.number("to_s", "Its end", "s", of_time_cluster(&Row::to_s));
    to.number("mass", "Sum of t times seconds", "s", of_time_cluster(&Row::mass));
    to.number("difference", "Share of the time on the area, of a less that of b: mean over the cluster", "",
              of_time_cluster(&Row::difference));
    to.number("p", "Corrected over the presentation", "", of_time_cluster(&Row::p));
    to.number("p_of_all", "Corrected over all rows of this table, too", "", of_time_cluster(&Row::p_of_all));
    to.number("least_p", "The smallest p that so many observers can give", "",
              [](const Row& row) { return when(row.absent.empty(), row.least_p); });
    to.text("absent", "Why there is no test; n/a: there is one", &Row::absent);
    return to;
}

RowLayout<FirstFixationsRow> first_fixations_layout(const StudyResults& results) {
    using Row = FirstFixationsRow;
    StudyLayout<Row> to(
        "first_fixations",
        "Where the first fixations of trials go, one by one: of all trials, and of each level of each "
        "column; of trials that have so many, on objects with the area.");
    to.text("area", "The area", &Row::area);
    to.keys(results.by, &Row::keys);
    to.count("number", "Of the counted fixation since the onset, from 1", &Row::number);
    to.estimate("at", "Share of trials whose fixation of this number is on the area", "", &Row::at);
    to.estimate("up_to", "Share of the fixations up to this one that are, of a trial", "", &Row::up_to);
    to.count("observers", "Observers", &Row::observers);
    to.count("trials", "Trials with so many", &Row::trials);
    return to;
}

RowLayout<ScanpathRow> scanpaths_layout(const StudyResults& results) {
    using Row = ScanpathRow;
    StudyLayout<Row> to(
        "scanpaths",
        "How gaze goes over the surface: of groups, of each level of each column, and of all; means "
        "over each observer's trials, then over observers.");
    to.keys(results.by, &Row::keys);
    to.estimate("fixations", "Counted fixations of a trial", "", &Row::fixations);
    to.estimate("fixation_s", "Duration of one, mean of a trial", "s", &Row::fixation_s);
    to.estimate("step_mm", "Way along the surface from one fixation to the next, mean of a trial", "mm",
                &Row::step_mm);
    to.estimate("step_deg", "The same in degrees at the depth of the axis", "deg", &Row::step_deg);
    to.estimate("way_mm", "Sum of these ways in a trial", "mm", &Row::way_mm);
    to.estimate("coverage",
                "Share of the visible surface no farther than the kernel's standard deviation from any "
                "fixation of the "
                "trial, along the surface",
                "", &Row::coverage);
    to.estimate(
        "effective_share",
        "2 to the entropy of a trial's map, in bits, over the visible area: the share of the surface that an "
        "even map of the same entropy would have",
        "", &Row::entropy);
    to.estimate("recurrence",
                "Share of the pairs of a trial's fixations that are no farther from each other than the "
                "kernel's standard "
                "deviation, along the surface",
                "", &Row::recurrence);
    to.estimate(
        "determinism",
        "Share of these pairs that belong to a repeated way: the next fixations of both are a pair, too, or "
        "those before",
        "", &Row::determinism);
    to.estimate(
        "return_distance",
        "Number of fixations between the two of such a pair, as a share of those of the trial: large where "
        "gaze comes back late",
        "", &Row::return_distance);
    to.count("observers", "Observers", &Row::observers);
    to.count("trials", "Trials with counted fixations", &Row::trials);
    return to;
}

RowLayout<ScanpathLikenessRow> scanpath_likeness_layout(const StudyResults& results) {
    using Row = ScanpathLikenessRow;
    StudyLayout<Row> to(
        "scanpath_likeness",
        "How alike the ways of gaze of two observers on one object are, who saw the same level of a "
        "factor or different ones: means over pairs of observers, 1 where they are the same.");
    to.text("measure",
            "scanmatch: where gaze is, at what time and in what order; multimatch_: shape, length, direction "
            "of steps, "
            "position and duration of fixations, after an alignment",
            &Row::measure);
    std::vector<std::string> others = results.by;
    std::erase(others, "object");
    to.keys(others, &Row::keys);
    add_levels(to);
    to.estimate("same_level", "Of two observers who saw the same level", "", &Row::same_level);
    to.estimate("other_level", "Of two observers who saw different levels", "", &Row::other_level);
    to.estimate("level_effect", "The former less the latter: 0 where levels make no difference", "",
                &Row::level_effect);
    to.estimate(
        "shuffled",
        "Of two who saw the same level, with the fixations of one in an order by chance: what same_level is "
        "above it is due to the order",
        "", &Row::shuffled);
    to.count("observers", "Observers with both levels", &Row::observers);
    return to;
}

} // namespace overt
