#include "experiment/analysis/coordinate_maps.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "experiment/error.h"

namespace overt {

namespace {

constexpr std::uint32_t no_triangle = std::numeric_limits<std::uint32_t>::max();

/// Steps from triangle to triangle before a sight line is given up; a pixel is seldom more than a few
/// triangles wide.
constexpr int longest_walk = 24;

/// Triangles that share an edge. Where more than two do, any of them.
std::vector<std::array<std::uint32_t, 3>> neighbours_of(const Mesh& mesh) {
    struct Side {
        std::uint64_t edge;
        std::uint32_t triangle;
        std::uint32_t corner; ///< opposite the edge
    };
    std::vector<Side> sides;
    sides.reserve(3 * mesh.triangles.size());
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const glm::uvec3 triangle = mesh.triangles[t];
        for (std::uint32_t corner = 0; corner < 3; ++corner) {
            const std::uint64_t a = triangle[static_cast<int>((corner + 1) % 3)],
                                b = triangle[static_cast<int>((corner + 2) % 3)];
            sides.push_back({std::min(a, b) << 32 | std::max(a, b), t, corner});
        }
    }
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
        return a.edge != b.edge ? a.edge < b.edge : a.triangle < b.triangle;
    });
    std::vector<std::array<std::uint32_t, 3>> neighbours(mesh.triangles.size(),
                                                         {no_triangle, no_triangle, no_triangle});
    for (std::size_t i = 0; i + 1 < sides.size(); ++i) {
        const Side &one = sides[i], &other = sides[i + 1];
        if (one.edge != other.edge)
            continue;
        neighbours[one.triangle][one.corner] = other.triangle;
        neighbours[other.triangle][other.corner] = one.triangle;
    }
    return neighbours;
}

} // namespace

CoordinateMaps::CoordinateMaps(const Mesh& mesh, const SceneView& scene, std::vector<Degrees> angles,
                               std::vector<TriangleMap> maps)
    : mesh_(&mesh), scene_(scene), maps_(std::move(maps)), neighbours_(neighbours_of(mesh)) {
    OVERT_EXPECTS(angles.size() == maps_.size());
    for (const TriangleMap& map : maps_) {
        if (map.size_px != scene.view.image_px) {
            throw InputError(fmt::format("a map of {} x {} pixels was given for an image of {} x {}",
                                         map.size_px.x, map.size_px.y, scene.view.image_px.x,
                                         scene.view.image_px.y));
        }
        if (*std::max_element(map.codes.begin(), map.codes.end()) > mesh.triangles.size()) {
            throw InputError(fmt::format(
                "a map names a triangle that the mesh of {} does not have: it belongs to another mesh",
                mesh.triangles.size()));
        }
    }
    const View& view = scene.view;
    const double px_at_unit_depth =
        0.5 * view.image_px.y / std::tan(0.5 * to_radians(view.camera.vertical_fov).value);
    const glm::dmat4 view_from_world = view.view_from_world();
    for (const Degrees angle : angles) {
        // Rows of the rotation are the camera's axes seen from the object.
        const glm::dmat4 view_from_object = view_from_world * scene.pose_at(angle).world_from_object();
        const glm::dmat3 object_from_view = glm::transpose(glm::dmat3(view_from_object));
        sight_lines_.push_back({object_from_view * -glm::dvec3(view_from_object[3]), -object_from_view[2],
                                object_from_view[0] / px_at_unit_depth,
                                -object_from_view[1] / px_at_unit_depth});
    }
}

std::optional<CoordinateMaps::Meeting> CoordinateMaps::walk(std::uint32_t triangle, glm::dvec3 origin,
                                                            glm::dvec3 direction) const {
    std::uint32_t came_from = no_triangle;
    for (int step = 0; step < longest_walk; ++step) {
        const glm::uvec3 corners = mesh_->triangles[triangle];
        const glm::dvec3 a = glm::dvec3(mesh_->positions[corners.x]) - origin;
        const glm::dvec3 b = glm::dvec3(mesh_->positions[corners.y]) - origin;
        const glm::dvec3 c = glm::dvec3(mesh_->positions[corners.z]) - origin;
        // Volumes spanned by the sight line and each edge: all of one sign where it passes inside.
        glm::dvec3 volumes(glm::dot(direction, glm::cross(b, c)), glm::dot(direction, glm::cross(c, a)),
                           glm::dot(direction, glm::cross(a, b)));
        const double sum = volumes.x + volumes.y + volumes.z;
        if (sum == 0.0)
            return std::nullopt; // seen edge-on
        volumes /= sum;
        if (volumes.x >= 0.0 && volumes.y >= 0.0 && volumes.z >= 0.0) {
            const glm::dvec3 normal = glm::cross(b - a, c - a);
            const double depth = glm::dot(normal, a) / glm::dot(normal, direction);
            if (!(depth > 0.0))
                return std::nullopt;
            return Meeting{triangle, volumes, depth};
        }
        // Across the edge that it passes farthest outside, but not back to where the walk came from.
        std::uint32_t next = no_triangle;
        double farthest = 0.0;
        for (int corner = 0; corner < 3; ++corner) {
            const std::uint32_t neighbour = neighbours_[triangle][static_cast<std::size_t>(corner)];
            if (volumes[corner] < farthest && neighbour != no_triangle && neighbour != came_from) {
                farthest = volumes[corner];
                next = neighbour;
            }
        }
        if (next == no_triangle)
            return std::nullopt;
        came_from = triangle;
        triangle = next;
    }
    return std::nullopt;
}

std::optional<SurfacePoint> CoordinateMaps::surface_at(PoseIndex pose, glm::dvec2 point) const {
    const TriangleMap& map = maps_[static_cast<std::size_t>(pose.value)];
    const SightLines& lines = sight_lines_[static_cast<std::size_t>(pose.value)];
    // Also turns away what is not a number.
    if (!(point.x >= -1.0 && point.y >= -1.0 && point.x <= map.size_px.x + 1.0 &&
          point.y <= map.size_px.y + 1.0))
        return std::nullopt;
    const glm::dvec2 off_centre = point - 0.5 * glm::dvec2(map.size_px);
    const glm::dvec3 direction =
        lines.forward + off_centre.x * lines.right_per_px + off_centre.y * lines.down_per_px;

    const int column = static_cast<int>(std::floor(point.x)), row = static_cast<int>(std::floor(point.y));
    std::array<std::uint32_t, 9> tried{};
    std::size_t tries = 0;
    std::optional<Meeting> nearest;
    for (const auto& [dx, dy] :
         {std::pair{0, 0}, {-1, 0}, {1, 0}, {0, -1}, {0, 1}, {-1, -1}, {1, -1}, {-1, 1}, {1, 1}}) {
        const std::uint32_t code = map.code_at(column + dx, row + dy);
        if (code == 0 || std::find(tried.begin(), tried.begin() + static_cast<std::ptrdiff_t>(tries), code) !=
                             tried.begin() + static_cast<std::ptrdiff_t>(tries))
            continue;
        tried[tries++] = code;
        const std::optional<Meeting> meeting = walk(code - 1, lines.origin, direction);
        if (meeting && (!nearest || meeting->depth < nearest->depth))
            nearest = meeting;
    }
    if (!nearest)
        return std::nullopt;

    const glm::uvec3 corners = mesh_->triangles[nearest->triangle];
    const glm::dvec3 a(mesh_->positions[corners.x]), b(mesh_->positions[corners.y]),
        c(mesh_->positions[corners.z]);
    SurfacePoint surface;
    surface.position = lines.origin + nearest->depth * direction;
    surface.triangle = nearest->triangle;
    surface.barycentric = nearest->barycentric;
    surface.part = mesh_->triangle_parts[nearest->triangle];
    surface.depth = nearest->depth;
    const double cosine =
        std::abs(glm::dot(glm::normalize(glm::cross(b - a, c - a)), glm::normalize(direction)));
    surface.incidence = to_degrees({std::acos(std::min(cosine, 1.0))});
    return surface;
}

} // namespace overt
