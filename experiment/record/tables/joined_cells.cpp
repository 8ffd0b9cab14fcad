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

/// What a function makes of the place on the surface.
auto of_surface(auto of) {
    return [of](const JoinedRow& row) { return of_maybe(row.joined.sight.surface, of); };
}
auto coordinate(int axis) {
    return of_surface([axis](auto& surface) { return Fixed{surface.position[axis], surface_decimals}; });
}
/// In the stimulus's image.
auto image_place(int axis) {
    return [axis](const JoinedRow& row) {
        return of_maybe(row.joined.image_px, [axis](auto& px) { return Fixed{px[axis], pixel_decimals}; });
    };
}

} // namespace

std::optional<Fixed> angle_of(const SessionHeader& header, PoseIndex pose) {
    return of_maybe(item_of(header.poses.angles, pose.value), [](const ObjectPose& object) {
        return Fixed{object.angle.value, angle_decimals};
    });
}

std::optional<Fixed> gaze_x(const JoinedRow& row) {
    return of_maybe(row.sample.gaze, [](auto& gaze) { return Fixed{gaze.x_px, pixel_decimals}; });
}

std::optional<Fixed> gaze_y(const JoinedRow& row) {
    return of_maybe(row.sample.gaze, [](auto& gaze) { return Fixed{gaze.y_px, pixel_decimals}; });
}

std::optional<Fixed> pupil_size(const JoinedRow& row) {
    const float area = row.sample.pupil_area;
    return when(area > 0.0f, Fixed{shortest_decimal(area), pupil_decimals});
}

std::int64_t tracker_time_us(const JoinedRow& row) { return microseconds_of(row.sample.sampled_at); }

std::vector<std::string> all_part_names(const SessionHeader& header) {
    std::vector<std::string> names;
    for (const RecordedObject& object : header.objects)
        for (const std::string& name : object.part_names)
            if (std::find(names.begin(), names.end(), name) == names.end())
                names.push_back(name);
    return names;
}

TableColumn part_column(const SessionHeader& header) {
    TableColumn part{"part", "Part of the figure that is looked at"};
    for (const std::string& name : all_part_names(header))
        part.levels.emplace_back(name, fmt::format("the triangles labelled \"{}\"", name));
    return part;
}

Fixed surface_coordinate(double value) { return Fixed{value, surface_decimals}; }

std::vector<std::string> part_cells_of(const SessionHeader& header, int object, TableFormat format) {
    std::vector<std::string> cells;
    for (const std::string& name : header.objects[static_cast<std::size_t>(object)].part_names)
        cells.push_back(text_cell(name, format));
    return cells;
}

LengthWords length_words(const SessionHeader& header) {
    std::vector<std::string> own, unknown;
    for (const RecordedObject& object : header.objects) {
        if (object.unit == "own")
            own.push_back(object.id);
        else if (object.unit != "mm")
            unknown.push_back(object.id);
    }
    if (own.empty() && unknown.empty())
        return {"mm", ""};
    LengthWords words;
    words.unit = own.size() + unknown.size() < header.objects.size() ? "mm, or as the description says"
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
         [](auto& row) { return of_maybe(row.joined.at, &MappedTime::time); }},
        {{"time_uncertainty_s", "Bound on the error of time_s", "s"},
         [](auto& row) { return of_maybe(row.joined.at, &MappedTime::uncertainty); }},
    };
}

JoinedColumns place_columns(const SessionHeader& header) {
    const LengthWords length = length_words(header);
    const std::string& mesh_unit = length.unit;
    return {
        {{"frame", "Animation frame lit at the gaze's row"},
         [](auto& row) { return of_maybe(row.joined.shown, [](auto& shown) { return shown.frame.value; }); }},
        {SharedColumns(header).angle,
         [&header](auto& row) {
             return of_maybe(row.joined.shown, [&](auto& shown) { return angle_of(header, shown.pose); });
         }},
        {{"image_x_px", "Gaze in the stimulus image, to the right", "px"}, image_place(0)},
        {{"image_y_px", "Gaze in the stimulus image, downwards", "px"}, image_place(1)},
        {{"surface_x", fmt::format("Place on the unturned surface{}", length.remark), mesh_unit},
         coordinate(0)},
        {{"surface_y", fmt::format("Place on the unturned surface{}", length.remark), mesh_unit},
         coordinate(1)},
        {{"surface_z", fmt::format("Place on the unturned surface, upwards{}", length.remark), mesh_unit},
         coordinate(2)},
        {{"triangle", "Index of the mesh's triangle, from 0; n/a where maps were given without a mesh"},
         of_surface([](auto& surface) { return when(surface.triangle != no_triangle, surface.triangle); })},
        {part_column(header),
         [](auto& to, auto& row) {
             const auto& surface = row.joined.sight.surface;
             const auto index = surface ? static_cast<std::size_t>(surface->part) : row.part_cells.size();
             index < row.part_cells.size() ? to.ready(row.part_cells[index]) : to.missing();
         }},
        {{"depth",
          fmt::format("Distance of the surface from the camera along the viewing direction{}", length.remark),
          mesh_unit},
         of_surface([](auto& surface) {
             return Fixed{surface.depth, surface_decimals};
         })},
        {{"incidence_deg", "Angle between the line of sight and the surface's normal, 0 is head-on", "deg"},
         of_surface([](auto& surface) {
             return Fixed{surface.incidence.value, incidence_decimals};
         })},
        {{"silhouette_distance_deg",
          "Visual angle from the gaze to the nearest place of the outline of the object's picture: "
          "positive "
          "beside the object, negative on it; n/a without gaze, when no frame was lit, or if the "
          "object "
          "has no map. Right to within a pixel",
          "deg"},
         [](auto& row) {
             return of_maybe(row.joined.outline_distance, [](Degrees away) {
                 return Fixed{away.value, silhouette_decimals};
             });
         }},
    };
}

} // namespace overt
