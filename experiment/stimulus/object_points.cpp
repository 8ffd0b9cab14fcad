#include "experiment/stimulus/object_points.h"

#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/base/error.h"
#include "experiment/protocol/protocol.h"
#include "experiment/scene/areas.h"

namespace overt {

namespace {

/// Rounding of a written sum of weights.
constexpr double weight_tolerance = 1e-6;

class PointPlacing {
  public:
    PointPlacing(const Protocol& protocol, const PointListSettings& list, const Mesh& mesh,
                 const SceneView& scene)
        : protocol_(protocol), list_(list), mesh_(mesh), scene_(scene), normals_(mesh.vertex_normals()) {}

    std::vector<ObjectPoint> all() {
        if (list_.evenly) {
            for (const SurfaceSite& site : spread())
                add(site);
            return std::move(points_);
        }
        for (const double vertex : list_.vertices)
            add_vertex(vertex);
        for (const std::array<double, 3>& place : list_.places)
            add_place(place);
        for (const std::array<double, 3>& near : list_.near_mm)
            add(nearest_site(mesh_, {near[0], near[1], near[2]}));
        return std::move(points_);
    }

  private:
    void add(const SurfaceSite& site, std::optional<std::uint32_t> vertex = {}) {
        points_.push_back({list_.name_of(static_cast<int>(points_.size())), site, position_of(mesh_, site),
                           shading_normal_of(mesh_, normals_, site), vertex});
    }
    void add_vertex(double written) {
        const auto vertex = static_cast<std::uint32_t>(written);
        if (written != std::floor(written) || vertex >= mesh_.positions.size())
            throw InputError(fmt::format("vertices: the mesh has the vertices 0 to {}, and no {:g}",
                                         mesh_.positions.size() - 1, written));
        const std::optional<SurfaceSite> site = site_of_vertex(mesh_, vertex);
        if (!site)
            throw InputError(fmt::format("vertices: vertex {} belongs to no triangle", vertex));
        add(*site, vertex);
    }
    void add_place(const std::array<double, 3>& place) {
        const auto [triangle, first, second] = place;
        if (triangle < 0.0 || triangle != std::floor(triangle) ||
            triangle >= static_cast<double>(mesh_.triangles.size()))
            throw InputError(fmt::format("places: the mesh has the triangles 0 to {}, and no {:g}",
                                         mesh_.triangles.size() - 1, triangle));
        if (first < 0.0 || second < 0.0 || first + second > 1.0 + weight_tolerance)
            throw InputError(fmt::format("places: the weights {:g} and {:g} lie outside of triangle {:g}",
                                         first, second, triangle));
        add({static_cast<std::uint32_t>(triangle), {first, second, std::max(0.0, 1.0 - first - second)}});
    }

    std::vector<SurfaceSite> spread() {
        const Areas areas(mesh_.part_names);
        const std::optional<std::size_t> area = areas.find(list_.area);
        if (!list_.area.empty() && !area)
            throw InputError(
                fmt::format("area: there is no area \"{}\"; there are {}", list_.area,
                            areas.empty() ? "none" : fmt::format("{}", fmt::join(areas.names(), ", "))));
        std::optional<RayCaster> caster;
        if (list_.facing_deg)
            caster.emplace(mesh_);
        const ObjectPose pose = protocol_.motions.front().object_in({list_.frame});
        const auto is_seen = [&](const SurfaceSite& site) {
            if (!caster)
                return true;
            const ObjectPoint point{"", site, position_of(mesh_, site),
                                    shading_normal_of(mesh_, normals_, site)};
            const SeenProbe seen = seen_point(mesh_, *caster, scene_, pose, point);
            return seen.is_visible && seen.attitude().slant <= Degrees{*list_.facing_deg};
        };
        const auto count = static_cast<std::size_t>(*list_.evenly);
        std::vector<SurfaceSite> sites = spread_sites(
            mesh_, count, static_cast<std::uint64_t>(list_.seed),
            [&](std::uint32_t triangle) {
                return !area || areas.holds(*area, mesh_.triangle_parts[triangle]);
            },
            is_seen);
        if (sites.size() < count)
            throw InputError(fmt::format("evenly: {} of {} places were found; hardly any of the surface is "
                                         "seen so{}",
                                         sites.size(), count,
                                         list_.area.empty() ? "" : " in area \"" + list_.area + "\""));
        return sites;
    }

    const Protocol& protocol_;
    const PointListSettings& list_;
    const Mesh& mesh_;
    const SceneView& scene_;
    std::vector<glm::vec3> normals_;
    std::vector<ObjectPoint> points_;
};

} // namespace

SeenProbe seen_point(const Mesh& mesh, const RayCaster& caster, const SceneView& scene,
                     const ObjectPose& angle, const ObjectPoint& point) {
    const glm::dmat4 world_from_object = scene.pose_at(angle).world_from_object();
    const glm::dmat4 view_from_object = scene.view.view_from_world() * world_from_object;
    SeenProbe seen;
    seen.position = view_from_object * glm::dvec4(point.position, 1.0);
    seen.normal = glm::normalize(glm::dmat3(view_from_object) * point.normal);
    // Rotations alone: the transpose goes back.
    const glm::dvec3 eye = glm::transpose(glm::dmat3(view_from_object)) * -glm::dvec3(view_from_object[3]);
    const glm::dvec3 to_eye = eye - point.position;
    if (seen.position.z >= 0.0 || glm::dot(normal_of_triangle(mesh, point.site.triangle), to_eye) <= 0.0)
        return seen;
    const glm::dvec2 at = scene.view.project(world_from_object * glm::dvec4(point.position, 1.0));
    const glm::dvec2 size(scene.view.image_px);
    seen.is_visible = at.x >= 0.0 && at.y >= 0.0 && at.x < size.x && at.y < size.y &&
                      !caster.is_hidden(point.position, eye);
    return seen;
}

bool is_on_object(const Protocol& protocol, const PointListSettings& list, std::size_t object) {
    return list.object.empty() || protocol.objects[object].id == list.object;
}

std::vector<ObjectPoint> points_on(const Protocol& protocol, const PointListSettings& list, const Mesh& mesh,
                                   const SceneView& scene) {
    return PointPlacing(protocol, list, mesh, scene).all();
}

} // namespace overt
