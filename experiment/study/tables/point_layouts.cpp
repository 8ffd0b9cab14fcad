#include "experiment/study/tables/point_layouts.h"

#include "experiment/study/tables/study_layout.h"

namespace overt {

namespace {

template <class Row> void add_points_of(StudyLayout<Row>& to, const StudyResults& results) {
    to.text("observer", "Label of the observer; all: all together",
            [](const Row& row) { return row.of.observer.empty() ? std::string("all") : row.of.observer; });
    to.text("task", "Id of the task", [](const Row& row) { return row.of.task; });
    to.text("answer", "Id of the answer", [](const Row& row) { return row.of.answer; });
    to.object(results, [](const Row& row) { return row.of.object; });
}

template <class Row>
void add_place(StudyLayout<Row>& to, const std::string& prefix, const std::string& what,
               std::optional<glm::dvec3> Row::*place) {
    constexpr std::array names{"x", "y", "z"};
    for (int axis = 0; axis < 3; ++axis)
        to.number(prefix + names[static_cast<std::size_t>(axis)],
                  what + ", on the unturned surface, from the mesh's origin", mesh_unit,
                  [place, axis](const Row& row) {
                      return row.*place ? std::optional((*(row.*place))[axis]) : std::nullopt;
                  });
}

} // namespace

RowLayout<AnsweredPointRow> answered_points_layout(const StudyResults& results) {
    using Row = AnsweredPointRow;
    StudyLayout<Row> to("answered_points",
                        "Each place that was pointed at as an answer, in trials that give results.");
    add_points_of(to, results);
    to.text("session", "Folder of the session", [&results](const Row& row) {
        return results.sessions[static_cast<std::size_t>(row.session)].folder;
    });
    to.count("trial", "Position of the trial in the observer's order, from 1", &Row::trial);
    to.text("by", "What pointed: mouse, gaze or fixation", &Row::by);
    add_place(to, "", "The place; n/a: beside the object", &Row::place);
    to.count("triangle", "Index of the mesh's triangle, from 0", &Row::triangle);
    to.text("part", "Part of the surface", &Row::part_name);
    to.number("sd",
              "Standard deviation of the place on the surface along the longer axis of its ellipse, by how "
              "exactly it was pointed: within the pixel, or the accuracy of gaze by its validation",
              mesh_unit, &Row::largest_sd);
    to.number("response_s", "Response time, from the zero that the protocol names", "s", &Row::response_s);
    return to;
}

RowLayout<PointSpreadRow> point_spreads_layout(const StudyResults& results) {
    using Row = PointSpreadRow;
    StudyLayout<Row> to(
        "answered_point_spreads",
        "How the places that were pointed at lie to each other. Distances go straight through "
        "space; of an object whose scale is not known they are in its own unit.");
    add_points_of(to, results);
    to.count("answers", "Answers", &Row::answers);
    to.count("on_surface", "Of these on the object", &Row::on_surface);
    to.count("observers", "Observers who pointed at the object", &Row::observers);
    add_place(to, "middle_", "That of the places with the least sum of squared distances to all others",
              &Row::middle);
    to.text("middle_part", "Part of the surface that it is on", &Row::middle_part);
    to.number("spread_mm", "Root mean square of the distances from it", "mm", &Row::spread_mm);
    to.estimate("within_mm", "Mean distance of two places of one observer; of all, mean over observers", "mm",
                &Row::within_mm);
    to.estimate("between_mm", "Mean distance of two places of different observers", "mm", &Row::between_mm);
    to.number(
        "chance_mm",
        "Mean distance of two places drawn evenly from the object's pictures, for as long as they are shown",
        "mm", &Row::chance_mm);
    to.estimate("of_chance", "between_mm as a share of chance_mm: 1 is no more alike than by chance", "",
                &Row::of_chance);
    return to;
}

RowLayout<PointAreaRow> point_areas_layout(const StudyResults& results) {
    using Row = PointAreaRow;
    StudyLayout<Row> to("answered_point_areas", "On which areas the places lie that were pointed at.");
    add_points_of(to, results);
    to.text("area", "Name of the area", &Row::area);
    to.count("answers", "Answers on the object", &Row::answers);
    to.count("on_area", "Of these on the area", &Row::on_area);
    to.count("observers", "Observers", &Row::observers);
    to.estimate("share", "Share of the answers on the area; of all, mean over observers", "", &Row::share);
    to.number("by_chance", "What it would be of places drawn evenly from the object's pictures", "",
              &Row::by_chance);
    return to;
}

RowLayout<PointPairRow> point_pairs_layout(const StudyResults& results) {
    using Row = PointPairRow;
    StudyLayout<Row> to("answered_point_pairs",
                        "How far two places lie apart that were answers of one trial.");
    to.text("observer", "Label of the observer; all: all together",
            [](const Row& row) { return row.observer.empty() ? std::string("all") : row.observer; });
    to.text("task", "Id of the task", &Row::task);
    to.text("first", "Id of one answer", &Row::first);
    to.text("second", "Id of the other", &Row::second);
    to.object(results, &Row::object);
    to.count("trials", "Trials that have both on the object", &Row::trials);
    to.count("observers", "Observers", &Row::observers);
    to.estimate("distance_mm", "Mean distance, straight through space; of all, mean over observers", "mm",
                &Row::distance_mm);
    return to;
}

} // namespace overt
