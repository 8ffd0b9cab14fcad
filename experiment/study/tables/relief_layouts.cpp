#include "experiment/study/tables/relief_layouts.h"

#include "experiment/study/tables/study_layout.h"

namespace overt {

namespace {

template <class Row> void add_relief_of(StudyLayout<Row>& to) {
    to.text("observer", "Label of the observer; all: all together",
            [](const Row& row) { return row.of.observer.empty() ? std::string("all") : row.of.observer; });
    to.text("task", "Id of the task", [](const Row& row) { return row.of.task; });
    to.text("answer", "Id of the answer", [](const Row& row) { return row.of.answer; });
    to.text("object", "Whose surface it is", [](const Row& row) { return row.of.object; });
    to.text("material", "In which material it was shown", [](const Row& row) { return row.of.material; });
    to.text("light", "Under which light", [](const Row& row) { return row.of.light; });
    to.text("motion", "In which motion", [](const Row& row) { return row.of.motion; });
    to.text("view", "In which view", [](const Row& row) { return row.of.view; });
    to.count("frame", "Animation frame in which it was set", [](const Row& row) { return row.of.frame; });
}

template <class Row>
void add_attitudes(StudyLayout<Row>& to, Attitude Row::*set, const std::string& of_what) {
    to.number("slant_deg", of_what + ": angle between the normal and the line of sight", "deg",
              [set](const Row& row) { return (row.*set).slant.value; });
    to.number("tilt_deg",
              of_what +
                  ": direction on the screen in which the normal leans, from the right counter-clockwise",
              "deg", [set](const Row& row) { return (row.*set).tilt.value; });
    to.number("true_slant_deg", "The same of the surface", "deg", [](const Row& row) {
        return row.truth ? std::optional(row.truth->slant.value) : std::nullopt;
    });
    to.number("true_tilt_deg", "The same of the surface", "deg",
              [](const Row& row) { return row.truth ? std::optional(row.truth->tilt.value) : std::nullopt; });
}

} // namespace

RowLayout<GaugeSettingRow> gauge_settings_layout(const StudyResults& results) {
    using Row = GaugeSettingRow;
    StudyLayout<Row> to(
        "gauge_settings",
        "What was set with gauges where their places were seen, in trials that give results.");
    add_relief_of(to);
    to.text("session", "Folder of the session", [&results](const Row& row) {
        return results.sessions[static_cast<std::size_t>(row.session)].folder;
    });
    to.count("trial", "Position of the trial in the observer's order, from 1", &Row::trial);
    to.text("point", "Name of the place", &Row::point);
    add_attitudes(to, &Row::set, "As it was set");
    to.number("deviation_deg", "Between both normals", "deg", [](const Row& row) {
        return row.truth ? std::optional(angle_between(row.set, *row.truth).value) : std::nullopt;
    });
    to.count("at_limit", "Whether it could not be slanted further", &Row::is_at_limit);
    to.number("response_s", "Response time, from the zero that the protocol names", "s", &Row::response_s);
    return to;
}

RowLayout<ReliefPointRow> relief_points_layout() {
    using Row = ReliefPointRow;
    StudyLayout<Row> to("relief_points",
                        "The places of reliefs: settings, the relief, and the surface itself.");
    add_relief_of(to);
    to.text("point", "Name of the place", &Row::point);
    to.count("settings", "Settings there", &Row::settings);
    add_attitudes(to, &Row::mean, "Of the mean of the unit normals that were set");
    to.number("resultant", "Length of that mean: 1 if all are alike", "", &Row::resultant);
    to.number("deviation_deg", "Between the mean normal and the true one", "deg", &Row::deviation_deg);
    to.number("x", "Place to the right of the camera's axis, in the mean depth", mesh_unit, &Row::x);
    to.number("y", "The same upwards", mesh_unit, &Row::y);
    to.number("z", "Of the relief, towards the eye, from the mean depth; n/a: there is none", mesh_unit,
              &Row::z);
    to.number("true_z", "Of the surface, towards the eye, from the mean depth", mesh_unit, &Row::true_z);
    return to;
}

RowLayout<ReliefRow> reliefs_layout() {
    using Row = ReliefRow;
    StudyLayout<Row> to(
        "reliefs",
        "Reliefs that settings of gauges speak of, by least squares over neighbouring places, and "
        "their regression on the surface that was seen: z = a + gain true, and, since reliefs that "
        "differ by such a change look alike, z = a + affine_gain true + x_shear x + y_shear y.");
    add_relief_of(to);
    to.count("settings", "Settings", &Row::settings);
    to.count("points", "Places", &Row::points);
    to.count("edges", "Pairs of neighbours", &Row::edges);
    to.count("clipped", "Places whose mean was steeper than 85 deg and counts as that", &Row::clipped);
    to.number("deviation_deg", "Mean angle between the normals that were set and the true ones", "deg",
              &Row::deviation_deg);
    to.number("repeat_sd_deg", "Standard deviation of the normals at a place about their mean, pooled", "deg",
              &Row::repeat_sd_deg);
    to.number("residual", "What settings contradict each other by: root mean square over pairs of neighbours",
              mesh_unit, &Row::residual);
    to.number("gain", "Depth of the relief for one of the surface", "", &Row::gain);
    to.number("r", "Correlation of the relief with the surface", "", &Row::r);
    to.number("affine_gain", "The same gain with shears beside it", "", &Row::affine_gain);
    to.number("x_shear", "What the relief rises to the right besides", "", &Row::x_shear);
    to.number("y_shear", "What it rises upwards besides", "", &Row::y_shear);
    to.number("affine_r", "Multiple correlation with shears", "", &Row::affine_r);
    to.text("note", "Why there is none of these; n/a: there are", &Row::note);
    to.estimate(
        "attitude_gain",
        "What the depth rises at places, as it was set, for one of the surface's: regression of both "
        "components of all settings, without those where the surface is seen more steeply than 75 deg",
        "", &Row::attitude_gain);
    to.number("attitude_x_shear", "What it rises to the right besides, away from the eye", "",
              &Row::attitude_x_shear);
    to.number("attitude_y_shear", "What it rises upwards besides", "", &Row::attitude_y_shear);
    to.number("attitude_r", "Correlation of the rises", "", &Row::attitude_r);
    to.number("planted", "Of simulated observers: the gain that they were given", "", &Row::planted);
    return to;
}

} // namespace overt
