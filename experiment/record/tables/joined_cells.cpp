#include "experiment/record/tables/joined_cells.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/base/number_text.h"
#include "experiment/maps/surface_walk.h"
#include "experiment/record/tables/shared_columns.h"

namespace overt {
namespace {

constexpr int surface_decimals = 6; // a nanometre, if the mesh is in millimetres
constexpr int incidence_decimals = 4;
constexpr int silhouette_decimals = 4; // a hundredth of a pixel

} // namespace

void write_angle(TableCells& to, const SessionHeader& header, PoseIndex pose) {
    const Degrees* const angle = item_of(header.poses.angles, pose.value);
    angle ? to.fixed(angle->value, angle_decimals) : to.missing();
}

void write_gaze_x(TableCells& to, const GazeSample& sample) {
    sample.gaze ? to.fixed(sample.gaze->x_px, pixel_decimals) : to.missing();
}

void write_gaze_y(TableCells& to, const GazeSample& sample) {
    sample.gaze ? to.fixed(sample.gaze->y_px, pixel_decimals) : to.missing();
}

void write_pupil(TableCells& to, const GazeSample& sample) {
    sample.pupil_area > 0.0f ? to.fixed(shortest_decimal(sample.pupil_area), pupil_decimals) : to.missing();
}

std::vector<std::string> all_part_names(const SessionHeader& header) {
    std::vector<std::string> names;
    for (const RecordedSculpture& sculpture : header.sculptures)
        for (const std::string& name : sculpture.part_names)
            if (std::find(names.begin(), names.end(), name) == names.end())
                names.push_back(name);
    return names;
}

std::vector<std::string> part_cells_of(const SessionHeader& header, int sculpture, TableFormat format) {
    std::vector<std::string> cells;
    for (const std::string& name : header.sculptures[static_cast<std::size_t>(sculpture)].part_names)
        cells.push_back(text_cell(name, format));
    return cells;
}

LengthWords length_words(const SessionHeader& header) {
    std::vector<std::string> own, unknown;
    for (const RecordedSculpture& sculpture : header.sculptures) {
        if (sculpture.unit == "own")
            own.push_back(sculpture.id);
        else if (sculpture.unit != "mm")
            unknown.push_back(sculpture.id);
    }
    if (own.empty() && unknown.empty())
        return {"mm", ""};
    LengthWords words;
    words.unit = own.size() + unknown.size() < header.sculptures.size() ? "mm, or as the description says"
                                                                        : "as the description says";
    if (!own.empty())
        words.remark += fmt::format("; of {} in the unit of the mesh or map, times the protocol's scale: the "
                                    "protocol does not know which that is",
                                    fmt::join(own, ", "));
    if (!unknown.empty())
        words.remark +=
            fmt::format("; of {} in millimetres if the protocol names the unit of the mesh, else in "
                        "that of the mesh, times the protocol's scale: this session was recorded by "
                        "an earlier program, which did not write the unit down",
                        fmt::join(unknown, ", "));
    return words;
}

JoinedColumns time_columns() {
    return {
        {session_seconds("time_s", "When the sample was taken"),
         [](auto& to, auto& row) { row.joined.at ? to.seconds(row.joined.at->time) : to.missing(); }},
        {{"time_uncertainty_s", "Bound on the error of time_s", "s", {}},
         [](auto& to, auto& row) { row.joined.at ? to.seconds(row.joined.at->uncertainty) : to.missing(); }},
    };
}

JoinedColumns place_columns(const SessionHeader& header) {
    TableColumn part{"part", "Part of the figure that is looked at", "", {}};
    for (const std::string& name : all_part_names(header))
        part.levels.emplace_back(name, fmt::format("the triangles labelled \"{}\"", name));
    const LengthWords length = length_words(header);
    const std::string& mesh_unit = length.unit;
    return {
        {{"frame", "Animation frame lit at the gaze's row", "", {}},
         [](auto& to, auto& row) {
             row.joined.shown ? to.integer(row.joined.shown->frame.value) : to.missing();
         }},
        {SharedColumns(header).angle,
         [&header](auto& to, auto& row) {
             row.joined.shown ? write_angle(to, header, row.joined.shown->pose)
                              : static_cast<void>(to.missing());
         }},
        {{"image_x_px", "Gaze in the stimulus image, to the right", "px", {}},
         [](auto& to, auto& row) {
             row.joined.image_px ? to.fixed(row.joined.image_px->x, pixel_decimals) : to.missing();
         }},
        {{"image_y_px", "Gaze in the stimulus image, downwards", "px", {}},
         [](auto& to, auto& row) {
             row.joined.image_px ? to.fixed(row.joined.image_px->y, pixel_decimals) : to.missing();
         }},
        {{"surface_x", fmt::format("Place on the unturned surface{}", length.remark), mesh_unit, {}},
         [](auto& to, auto& row) {
             const auto& surface = row.joined.sight.surface;
             surface ? to.fixed(surface->position.x, surface_decimals) : to.missing();
         }},
        {{"surface_y", fmt::format("Place on the unturned surface{}", length.remark), mesh_unit, {}},
         [](auto& to, auto& row) {
             const auto& surface = row.joined.sight.surface;
             surface ? to.fixed(surface->position.y, surface_decimals) : to.missing();
         }},
        {{"surface_z", fmt::format("Place on the unturned surface, upwards{}", length.remark), mesh_unit, {}},
         [](auto& to, auto& row) {
             const auto& surface = row.joined.sight.surface;
             surface ? to.fixed(surface->position.z, surface_decimals) : to.missing();
         }},
        {{"triangle",
          "Index of the mesh's triangle, from 0; n/a where maps were given without a mesh",
          "",
          {}},
         [](auto& to, auto& row) {
             const auto& surface = row.joined.sight.surface;
             surface && surface->triangle != no_triangle ? to.integer(surface->triangle) : to.missing();
         }},
        {part,
         [](auto& to, auto& row) {
             const auto& surface = row.joined.sight.surface;
             const auto index = surface ? static_cast<std::size_t>(surface->part) : row.part_cells.size();
             index < row.part_cells.size() ? to.ready(row.part_cells[index]) : to.missing();
         }},
        {{"depth",
          fmt::format("Distance of the surface from the camera along the viewing direction{}", length.remark),
          mesh_unit,
          {}},
         [](auto& to, auto& row) {
             const auto& surface = row.joined.sight.surface;
             surface ? to.fixed(surface->depth, surface_decimals) : to.missing();
         }},
        {{"incidence_deg",
          "Angle between the line of sight and the surface's normal, 0 is head-on",
          "deg",
          {}},
         [](auto& to, auto& row) {
             const auto& surface = row.joined.sight.surface;
             surface ? to.fixed(surface->incidence.value, incidence_decimals) : to.missing();
         }},
        {{"silhouette_distance_deg",
          "Visual angle from the gaze to the nearest place of the outline of the sculpture's picture: "
          "positive "
          "beside the sculpture, negative on it; n/a without gaze, when no frame was lit, or if the "
          "sculpture "
          "has no map. Right to within a pixel",
          "deg",
          {}},
         [](auto& to, auto& row) {
             const auto& distance = row.joined.outline_distance;
             distance ? to.fixed(distance->value, silhouette_decimals) : to.missing();
         }},
    };
}

} // namespace overt
