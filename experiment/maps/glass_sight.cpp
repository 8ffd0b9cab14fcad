#include "experiment/maps/glass_sight.h"

#include <algorithm>
#include <cmath>

#include "experiment/base/parallel.h"

namespace overt {

namespace {

/// A line goes on behind where it met the surface by this share of the body's size, so that it does not meet
/// the same place again: far more than coordinates are rounded by, far less than any mesh is fine.
constexpr double step_off_share = 1e-9;

/// Cosines below are taken for this one. The same as of the light's paths (render/bake/path_tracer.cpp), so
/// that both are bent alike.
constexpr double least_cosine = 1e-3, least_height = 1e-5;

/// More borders than any body that is not a trap has on a line.
constexpr int most_borders = 256;

glm::dvec3 facing(const glm::dvec3& normal, const glm::dvec3& to_eye) {
    const double cosine = glm::dot(normal, to_eye);
    return cosine >= least_cosine ? normal : glm::normalize(normal + (least_cosine - cosine) * to_eye);
}

/// On the side of the surface that it is to go to, also where the normal that it was bent at would send it to
/// the other.
glm::dvec3 above(const glm::dvec3& direction, const glm::dvec3& surface_normal) {
    const double height = glm::dot(direction, surface_normal);
    return height >= least_height
               ? direction
               : glm::normalize(direction +
                                (2.0 * least_height - 2.0 * std::min(height, 0.0)) * surface_normal);
}

} // namespace

GlassSight::GlassSight(const CoordinateMaps& maps, double index)
    : maps_(&maps), index_(index), step_off_(step_off_share * maps.mesh().bounds().diagonal()),
      normals_(corner_normals(maps.mesh(), lit_crease_deg)) {}

GlassSight::Normals GlassSight::normals_at(std::uint32_t triangle, const glm::dvec3& barycentric) const {
    const Mesh& mesh = maps_->mesh();
    const glm::uvec3 corners = mesh.triangles[triangle];
    const glm::dvec3 a(mesh.positions[corners.x]), b(mesh.positions[corners.y]), c(mesh.positions[corners.z]);
    const glm::dvec3 own = glm::normalize(glm::cross(b - a, c - a));
    glm::dvec3 mean(0.0);
    for (int corner = 0; corner < 3; ++corner)
        mean += barycentric[corner] * glm::dvec3(normals_[triangle][static_cast<std::size_t>(corner)]);
    const double length = glm::length(mean);
    return {length > 1e-3 ? mean / length : own, own};
}

std::optional<FarPoint> GlassSight::far_point(PoseIndex pose, const SurfacePoint& front) const {
    const SightLines& lines = maps_->sight_lines(pose);
    glm::dvec3 direction = glm::normalize(front.position - lines.origin());
    FarPoint at{front, 0};
    for (int border = 0; border < most_borders; ++border) {
        const Normals normals = normals_at(at.surface.triangle, at.surface.barycentric);
        const bool enters = glm::dot(normals.own, direction) < 0.0;
        const double side = enters ? 1.0 : -1.0, ratio = enters ? 1.0 / index_ : index_;
        const glm::dvec3 own = side * normals.own;
        glm::dvec3 bent_at = facing(side * normals.bent_at, -direction);
        glm::dvec3 through = glm::refract(direction, bent_at, ratio);
        if (through != glm::dvec3(0.0) && glm::dot(through, own) > -least_height) {
            bent_at = own; // the other would send it back
            through = glm::refract(direction, bent_at, ratio);
        }
        const bool is_mirrored = through == glm::dvec3(0.0);
        if (!enters && !is_mirrored) {
            at.surface.part = maps_->mesh().triangle_parts[at.surface.triangle];
            at.surface.depth = lines.project(at.surface.position).z;
            at.surface.incidence = to_degrees({std::acos(std::min(1.0, -glm::dot(own, direction)))});
            return at;
        }
        if (is_mirrored && ++at.reflections > most_total_reflections)
            return std::nullopt;
        direction = is_mirrored ? above(glm::reflect(direction, bent_at), own) : above(through, -own);
        const glm::dvec3 origin = at.surface.position + step_off_ * direction;
        const std::optional<RayHit> hit = maps_->rays().first_hit({origin, direction});
        if (!hit)
            return std::nullopt;
        at.surface.position = hit->position;
        at.surface.triangle = hit->triangle;
        at.surface.barycentric = hit->barycentric;
    }
    return std::nullopt;
}

CoordinateImage GlassSight::image(PoseIndex pose) const {
    CoordinateImage image(maps_->image_px());
    parallel_for(image.size_px.y, [&](int y) {
        for (int x = 0; x < image.size_px.x; ++x) {
            const std::optional<SurfacePoint> front = maps_->surface_at(pose, {x + 0.5, y + 0.5});
            if (const auto far = front ? far_point(pose, *front) : std::nullopt)
                image.at(x, y) = glm::vec4(far->surface.position, 1.0f);
        }
    });
    return image;
}

} // namespace overt
