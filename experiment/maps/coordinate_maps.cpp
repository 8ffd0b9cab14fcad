#include "experiment/maps/coordinate_maps.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/base/parallel.h"
#include "experiment/maps/continuity_check.h"
#include "experiment/maps/visible_depth.h"

namespace overt {

namespace {

/// How many places before their turn the memory that they need is sent for: first a place's pixel, and when
/// that is there, the triangle that it shows.
constexpr std::size_t cells_ahead = 16, triangles_ahead = 8;

void check_map(const Mesh& mesh, glm::ivec2 image_px, const TriangleMap& map) {
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

} // namespace

CoordinateMaps::CoordinateMaps(const Mesh& mesh, const SceneView& scene,
                               const std::vector<ObjectPose>& angles, std::vector<TriangleMap> maps, Use use)
    : CoordinateMaps(
          mesh, scene, angles,
          [&](PoseIndex pose) {
              OVERT_EXPECTS(angles.size() == maps.size());
              return std::move(maps[static_cast<std::size_t>(pose.value)]);
          },
          use) {}

CoordinateMaps::CoordinateMaps(const Mesh& mesh, const SceneView& scene,
                               const std::vector<ObjectPose>& angles,
                               const std::function<TriangleMap(PoseIndex)>& map_of, Use use)
    : mesh_(&mesh), image_px_(scene.view.image_px), walk_(mesh), caster_(mesh) {
    if (mesh.triangles.size() > PixelCell::most_triangles)
        throw InputError(fmt::format("a mesh of {} triangles is too large for a map", mesh.triangles.size()));
    for (const ObjectPose& angle : angles)
        sight_lines_.emplace_back(scene, angle);
    std::optional<Contours> contours;
    if (use == Use::many_lookups)
        contours.emplace(mesh);
    std::vector<std::optional<PoseCells>> cells(angles.size());
    parallel_for(static_cast<int>(angles.size()), [&](int index) {
        const auto pose = static_cast<std::size_t>(index);
        const TriangleMap map = map_of({index});
        check_map(mesh, image_px_, map);
        if (!contours) {
            cells[pose].emplace(map);
            return;
        }
        PixelFlags contested = contours->touched_pixels(
            sight_lines_[pose], image_px_, farthest_visible_depths(map, sight_lines_[pose], walk_));
        flag_discontinuities(map, sight_lines_[pose], walk_, contested);
        cells[pose].emplace(map, contested);
    });
    cells_.reserve(cells.size());
    for (std::optional<PoseCells>& of_pose : cells)
        cells_.push_back(*std::move(of_pose));
}

bool CoordinateMaps::cast(const SightLines& lines, const glm::dvec3& direction, Meeting& meeting) const {
    const double length = glm::length(direction);
    const std::optional<RayHit> hit = caster_.first_hit({lines.origin(), direction / length});
    if (!hit)
        return false;
    meeting = {hit->triangle, hit->barycentric, hit->distance / length};
    return true;
}

bool CoordinateMaps::meet(PoseIndex pose, PixelCell cell, const glm::dvec3& direction,
                          Meeting& meeting) const {
    const SightLines& lines = sight_lines(pose);
    if (cell.is_contested())
        return cast(lines, direction, meeting);
    if (!cell.is_covered())
        return false;
    return walk_.meet(cell.triangle(), lines.origin(), direction, meeting) || cast(lines, direction, meeting);
}

void CoordinateMaps::find_surface(const ImagePlace& place, std::optional<SurfacePoint>& surface) const {
    surface.reset();
    if (!is_in_image(place.point_px))
        return;
    const SightLines& lines = sight_lines(place.pose);
    const glm::dvec3 direction = lines.direction_through(place.point_px);
    Meeting meeting;
    if (!meet(place.pose, cells(place.pose).cell(glm::ivec2(place.point_px)), direction, meeting))
        return;
    const WalkTriangle& triangle = walk_.triangle(meeting.triangle);
    const glm::dvec3 a(triangle.corners[0]), b(triangle.corners[1]), c(triangle.corners[2]);
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const double cosine = std::abs(glm::dot(normal, direction)) /
                          std::sqrt(glm::dot(normal, normal) * glm::dot(direction, direction));
    SurfacePoint& point = surface.emplace();
    point.position = lines.origin() + meeting.depth * direction;
    point.triangle = meeting.triangle;
    point.barycentric = meeting.barycentric;
    point.part = triangle.part;
    point.depth = meeting.depth;
    point.incidence = to_degrees({std::acos(std::min(cosine, 1.0))});
}

std::optional<SurfacePoint> CoordinateMaps::surface_at(PoseIndex pose, glm::dvec2 point) const {
    std::optional<SurfacePoint> surface;
    find_surface({pose, point}, surface);
    return surface;
}

void CoordinateMaps::fetch_cell(const ImagePlace& place) const {
    if (!is_in_image(place.point_px))
        return;
    cells(place.pose).fetch(glm::ivec2(place.point_px));
}

void CoordinateMaps::fetch_triangle(const ImagePlace& place) const {
    if (!is_in_image(place.point_px))
        return;
    const PixelCell cell = cells(place.pose).cell(glm::ivec2(place.point_px));
    if (cell.is_covered())
        __builtin_prefetch(&walk_.triangle(cell.triangle()));
}

void CoordinateMaps::look(std::span<const ImagePlace> places, std::span<Sight* const> sights) const {
    OVERT_EXPECTS(places.size() == sights.size());
    for (std::size_t i = 0; i < std::min(places.size(), cells_ahead); ++i)
        fetch_cell(places[i]);
    for (std::size_t i = 0; i < std::min(places.size(), triangles_ahead); ++i)
        fetch_triangle(places[i]);
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (i + cells_ahead < places.size())
            fetch_cell(places[i + cells_ahead]);
        if (i + triangles_ahead < places.size())
            fetch_triangle(places[i + triangles_ahead]);
        Sight& sight = *sights[i];
        find_surface(places[i], sight.surface);
        sight.outline_px = cells(places[i].pose).outline_near(places[i].point_px, sight.surface.has_value());
    }
}

std::optional<PartIndex> CoordinateMaps::part_near(PoseIndex pose, glm::dvec2 point) const {
    if (!is_in_image(point))
        return std::nullopt;
    const PixelCell cell = cells(pose).cell(glm::ivec2(point));
    return cell.is_covered() ? std::optional(mesh_->triangle_parts[cell.triangle()]) : std::nullopt;
}

bool CoordinateMaps::goes_on(PoseIndex pose, glm::ivec2 pixel, glm::ivec2 neighbour) const {
    const PoseCells& of_pose = cells(pose);
    if (!of_pose.is_inside(pixel) || !of_pose.is_inside(neighbour))
        return false;
    const PixelCell here = of_pose.cell(pixel), there = of_pose.cell(neighbour);
    if (!here.is_covered() || !there.is_covered())
        return false;
    if (!here.is_contested() && !there.is_contested())
        return true;
    const SightLines& lines = sight_lines(pose);
    const glm::dvec3 direction = lines.direction_through(glm::dvec2(neighbour) + 0.5);
    Meeting walked, shown;
    return walk_.meet(here.triangle(), lines.origin(), direction, walked) &&
           walk_.meet(there.triangle(), lines.origin(), direction, shown) &&
           walked.triangle == shown.triangle;
}

bool CoordinateMaps::is_visible(PoseIndex pose, glm::dvec3 object_point) const {
    const glm::dvec3 seen = sight_lines(pose).project(object_point);
    return seen.z > 0.0 && is_in_image(glm::dvec2(seen)) &&
           !caster_.is_hidden(object_point, sight_lines(pose).origin());
}

} // namespace overt
