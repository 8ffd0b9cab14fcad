#include "experiment/analysis/coordinate_maps.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "experiment/analysis/sheet_check.h"
#include "experiment/error.h"
#include "experiment/parallel.h"

namespace overt {

namespace {

/// Places looked at in step with one another, so that each one's memory is on its way while the others are
/// worked on.
constexpr std::size_t in_step = 16;

void fetch_soon(const void* address) {
#if defined(__GNUC__)
    __builtin_prefetch(address);
#else
    static_cast<void>(address);
#endif
}

void check_maps(const Mesh& mesh, glm::ivec2 image_px, const std::vector<TriangleMap>& maps) {
    for (const TriangleMap& map : maps) {
        if (map.size_px != image_px) {
            throw InputError(fmt::format("a map of {} x {} pixels was given for an image of {} x {}",
                                         map.size_px.x, map.size_px.y, image_px.x, image_px.y));
        }
        if (*std::max_element(map.codes.begin(), map.codes.end()) > mesh.triangles.size()) {
            throw InputError(fmt::format(
                "a map names a triangle that the mesh of {} does not have: it belongs to another mesh",
                mesh.triangles.size()));
        }
    }
    if (mesh.triangles.size() > PixelCell::most_triangles)
        throw InputError(fmt::format("a mesh of {} triangles is too large for a map", mesh.triangles.size()));
}

} // namespace

CoordinateMaps::CoordinateMaps(const Mesh& mesh, const SceneView& scene, std::vector<Degrees> angles,
                               std::vector<TriangleMap> maps)
    : mesh_(&mesh), image_px_(scene.view.image_px), walk_(mesh), caster_(mesh) {
    OVERT_EXPECTS(angles.size() == maps.size());
    check_maps(mesh, image_px_, maps);
    for (const Degrees angle : angles)
        sight_lines_.emplace_back(scene, angle);
    const Contours contours(mesh);
    std::vector<std::optional<PoseCells>> cells(maps.size());
    parallel_for(static_cast<int>(maps.size()), [&](int index) {
        const auto pose = static_cast<std::size_t>(index);
        PixelFlags contested = contours.touched_pixels(sight_lines_[pose], image_px_);
        flag_broken_sheets(maps[pose], sight_lines_[pose], walk_, contested);
        cells[pose].emplace(maps[pose], contested);
        maps[pose] = {};
    });
    cells_.reserve(cells.size());
    for (std::optional<PoseCells>& of_pose : cells)
        cells_.push_back(*std::move(of_pose));
}

std::optional<Meeting> CoordinateMaps::cast(const SightLines& lines, const glm::dvec3& direction) const {
    const double length = glm::length(direction);
    const std::optional<RayHit> hit = caster_.first_hit({lines.origin(), direction / length});
    if (!hit)
        return std::nullopt;
    return Meeting{hit->triangle, hit->barycentric, hit->distance / length};
}

std::optional<Meeting> CoordinateMaps::meet(PoseIndex pose, PixelCell cell,
                                            const glm::dvec3& direction) const {
    const SightLines& lines = sight_lines(pose);
    if (cell.is_contested())
        return cast(lines, direction);
    if (!cell.is_covered())
        return std::nullopt;
    const std::optional<Meeting> meeting = walk_.meet(cell.triangle(), lines.origin(), direction);
    return meeting ? meeting : cast(lines, direction);
}

SurfacePoint CoordinateMaps::surface_of(const Meeting& meeting, const SightLines& lines,
                                        const glm::dvec3& direction) const {
    const WalkTriangle& triangle = walk_.triangle(meeting.triangle);
    const glm::dvec3 a(triangle.corners[0]), b(triangle.corners[1]), c(triangle.corners[2]);
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const double cosine = std::abs(glm::dot(normal, direction)) /
                          std::sqrt(glm::dot(normal, normal) * glm::dot(direction, direction));
    return {lines.origin() + meeting.depth * direction,
            meeting.triangle,
            meeting.barycentric,
            triangle.part,
            meeting.depth,
            to_degrees({std::acos(std::min(cosine, 1.0))})};
}

std::optional<SurfacePoint> CoordinateMaps::surface_at(PoseIndex pose, glm::dvec2 point) const {
    if (!is_in_image(point))
        return std::nullopt;
    const glm::dvec3 direction = sight_lines(pose).direction_through(point);
    const std::optional<Meeting> meeting = meet(pose, cells(pose).cell(glm::ivec2(point)), direction);
    return meeting ? std::optional(surface_of(*meeting, sight_lines(pose), direction)) : std::nullopt;
}

void CoordinateMaps::look_in_step(std::span<const ImagePlace> places, std::span<Sight> sights) const {
    for (const ImagePlace& place : places) {
        if (is_in_image(place.point_px))
            fetch_soon(&cells(place.pose).cell(glm::ivec2(place.point_px)));
    }
    for (const ImagePlace& place : places) {
        if (!is_in_image(place.point_px))
            continue;
        const PixelCell cell = cells(place.pose).cell(glm::ivec2(place.point_px));
        if (cell.is_covered())
            fetch_soon(&walk_.triangle(cell.triangle()));
    }
    for (std::size_t i = 0; i < places.size(); ++i) {
        const auto& [pose, point] = places[i];
        sights[i].surface = surface_at(pose, point);
        sights[i].outline_px = cells(pose).outline_near(point, sights[i].surface.has_value());
    }
}

void CoordinateMaps::look(std::span<const ImagePlace> places, std::span<Sight> sights) const {
    OVERT_EXPECTS(places.size() == sights.size());
    for (std::size_t begin = 0; begin < places.size(); begin += in_step) {
        const std::size_t count = std::min(in_step, places.size() - begin);
        look_in_step(places.subspan(begin, count), sights.subspan(begin, count));
    }
}

std::optional<PartIndex> CoordinateMaps::part_near(PoseIndex pose, glm::dvec2 point) const {
    if (!is_in_image(point))
        return std::nullopt;
    const PixelCell cell = cells(pose).cell(glm::ivec2(point));
    return cell.is_covered() ? std::optional(mesh_->triangle_parts[cell.triangle()]) : std::nullopt;
}

bool CoordinateMaps::is_one_sheet(PoseIndex pose, glm::ivec2 pixel, glm::ivec2 next) const {
    const PixelCell here = cells(pose).cell(pixel), there = cells(pose).cell(next);
    if (!here.is_covered() || !there.is_covered())
        return false;
    if (!here.is_contested() && !there.is_contested())
        return true;
    const SightLines& lines = sight_lines(pose);
    const glm::dvec3 direction = lines.direction_through(glm::dvec2(next) + 0.5);
    const std::optional<Meeting> walked = walk_.meet(here.triangle(), lines.origin(), direction);
    const std::optional<Meeting> shown = walk_.meet(there.triangle(), lines.origin(), direction);
    return walked && shown && walked->triangle == shown->triangle;
}

} // namespace overt
