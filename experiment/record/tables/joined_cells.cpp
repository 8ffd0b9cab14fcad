#include "experiment/record/tables/joined_cells.h"

#include "experiment/maps/surface_walk.h"

namespace overt {
namespace {

constexpr int surface_decimals = 6; // a nanometre, if the mesh is in millimetres
constexpr int incidence_decimals = 4;
constexpr int silhouette_decimals = 4; // a hundredth of a pixel

} // namespace

void write_angle(TableWriter& row, const SessionHeader& header, PoseIndex pose) {
    const std::vector<Degrees>& angles = header.poses.angles;
    if (pose.value >= 0 && static_cast<std::size_t>(pose.value) < angles.size())
        row.fixed(angles[static_cast<std::size_t>(pose.value)].value, angle_decimals);
    else
        row.missing();
}

JoinedCells::JoinedCells(const SessionHeader& header, int sculpture, TableFormat format) : header_(header) {
    for (const std::string& name : header.sculptures[static_cast<std::size_t>(sculpture)].part_names)
        parts_.push_back(prepare_cells({name}, format));
}

void JoinedCells::time(TableWriter& row, const JoinedSample& joined) const {
    if (joined.at)
        row.seconds(joined.at->time).seconds(joined.at->uncertainty);
    else
        row.missing(2);
}

void JoinedCells::place(TableWriter& row, const JoinedSample& joined) const {
    if (joined.shown) {
        row.integer(joined.shown->frame.value);
        write_angle(row, header_, joined.shown->pose);
    } else {
        row.missing(2);
    }
    if (joined.image_px)
        row.fixed(joined.image_px->x, pixel_decimals).fixed(joined.image_px->y, pixel_decimals);
    else
        row.missing(2);
    if (const auto& surface = joined.sight.surface) {
        for (const double coordinate : {surface->position.x, surface->position.y, surface->position.z})
            row.fixed(coordinate, surface_decimals);
        surface->triangle == no_triangle ? row.missing() : row.integer(surface->triangle);
        const auto part = static_cast<std::size_t>(surface->part);
        part < parts_.size() ? row.prepared(parts_[part]) : row.missing();
        row.fixed(surface->depth, surface_decimals).fixed(surface->incidence.value, incidence_decimals);
    } else {
        row.missing(7);
    }
    joined.outline_distance ? row.fixed(joined.outline_distance->value, silhouette_decimals) : row.missing();
}

} // namespace overt
