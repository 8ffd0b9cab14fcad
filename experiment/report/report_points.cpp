#include "experiment/report/report_points.h"

#include <set>

#include "experiment/scene/viewing.h"

namespace overt {

namespace {

/// So many places show what shape it is.
constexpr std::size_t most_of_shape = 2500;

Json of_row(const StudyResults& results, const PointsOf& of) {
    return {of.observer, of.task, of.answer, results.objects[static_cast<std::size_t>(of.object)].id};
}

Json image_place(const View& view, const glm::dvec3& place) {
    const glm::dvec2 at = view.project(place);
    return {number(at.x, 5), number(at.y, 5)};
}

Json picture_of(const StudyResults& results, int index) {
    const StudyObject& object = results.objects[static_cast<std::size_t>(index)];
    const View view{object.camera, object.screen.image_px};
    Json shape = Json::array(), places = Json::array();
    if (object.mesh) {
        const auto& positions = object.mesh->positions;
        const auto is_seen = [&](std::size_t v) {
            return object.seconds_visible.size() != positions.size() || object.seconds_visible[v] > 0.0f;
        };
        std::size_t seen = 0;
        for (std::size_t v = 0; v < positions.size(); ++v)
            seen += is_seen(v);
        const std::size_t step = seen / most_of_shape + 1;
        seen = 0;
        for (std::size_t v = 0; v < positions.size(); ++v)
            if (is_seen(v) && seen++ % step == 0)
                shape.push_back(image_place(view, glm::dvec3(positions[v])));
    }
    for (const AnsweredPointRow& point : results.points.given)
        if (point.of.object == index && point.place) {
            const Json at = image_place(view, *point.place);
            places.push_back(
                {at[0], at[1], point.of.task, point.of.answer, point.of.observer, point.part_name});
        }
    return {{"object", object.id},
            {"size", {object.screen.image_px.x, object.screen.image_px.y}},
            {"shape", std::move(shape)},
            {"places", std::move(places)}};
}

} // namespace

Json report_points(const StudyResults& results) {
    const StudyPoints& points = results.points;
    if (points.given.empty())
        return nullptr;
    Json spreads = Json::array(), areas = Json::array(), pairs = Json::array(), pictures = Json::array();
    for (const PointSpreadRow& row : points.spreads)
        spreads.push_back({{"of", of_row(results, row.of)},
                           {"answers", row.answers},
                           {"on_surface", row.on_surface},
                           {"observers", row.observers},
                           {"middle_part", row.middle_part},
                           {"spread", number(row.spread_mm)},
                           {"within", json_of(row.within_mm)},
                           {"between", json_of(row.between_mm)},
                           {"chance", number(row.chance_mm)},
                           {"of_chance", json_of(row.of_chance)}});
    for (const PointAreaRow& row : points.areas)
        areas.push_back({{"of", of_row(results, row.of)},
                         {"area", row.area},
                         {"answers", row.answers},
                         {"observers", row.observers},
                         {"share", json_of(row.share)},
                         {"chance", number(row.by_chance)}});
    for (const PointPairRow& row : points.pairs)
        pairs.push_back(
            {{"of", {row.observer, row.task, results.objects[static_cast<std::size_t>(row.object)].id}},
             {"first", row.first},
             {"second", row.second},
             {"trials", row.trials},
             {"observers", row.observers},
             {"distance", json_of(row.distance_mm)}});
    std::set<int> objects;
    for (const AnsweredPointRow& point : points.given)
        objects.insert(point.of.object);
    for (const int object : objects)
        pictures.push_back(picture_of(results, object));
    return {{"spreads", std::move(spreads)},
            {"areas", std::move(areas)},
            {"pairs", std::move(pairs)},
            {"pictures", std::move(pictures)}};
}

} // namespace overt
