#include "experiment/study/read/sculpture_surface.h"

#include <cmath>

#include <fmt/format.h>

#include "experiment/maps/coordinate_maps.h"

namespace overt {

std::optional<SurfaceScale> surface_scale(const Camera& camera, const glm::dvec3& axis_point,
                                          const ScreenGeometry& screen) {
    const double fov = to_radians(camera.vertical_fov).value;
    if (!(fov > 0.0) || !(screen.viewing_distance_mm > 0.0) || screen.screen_px.y <= 0 ||
        !(screen.screen_mm.y > 0.0))
        return std::nullopt;
    SurfaceScale scale;
    const View view{camera, screen.image_px};
    scale.axis_depth = view.depth_of({axis_point.x, axis_point.y, camera.target.z});
    if (!(scale.axis_depth > 0.0))
        return std::nullopt;
    // The height of the image is 2 tan(fov / 2) depths, and image_px.y pixels of the screen.
    const double mm_per_px = screen.screen_mm.y / screen.screen_px.y;
    scale.mm_per_unit = screen.image_px.y * mm_per_px / (2.0 * std::tan(0.5 * fov) * scale.axis_depth);
    scale.mm_per_deg = screen.viewing_distance_mm * std::tan(to_radians(Degrees{1.0}).value);
    return scale;
}

void add_surface(const SurfaceLookup* lookup, const std::string& fault, StudySculpture& sculpture,
                 SculptureSurface& surface) {
    surface.scale = surface_scale(sculpture.camera, sculpture.axis_point, sculpture.screen);
    const auto* maps = dynamic_cast<const CoordinateMaps*>(lookup);
    if (!lookup)
        sculpture.remark = fault.empty()
                               ? fmt::format("The sessions have no maps of {}: gaze on it has no place on "
                                             "a surface, and is not counted.",
                                             sculpture.id)
                               : fmt::format("The maps of {} cannot be used, so its gaze is not counted: {}",
                                             sculpture.id, fault);
    else if (!maps)
        sculpture.remark = fmt::format("Of {} there are ready-made maps and no mesh: fixations have places "
                                       "but there are no maps on the surface.",
                                       sculpture.id);
    else if (!surface.scale)
        sculpture.remark = fmt::format("The camera or the screen of {} is not known: there are no "
                                       "millimetres, and no maps.",
                                       sculpture.id);
    if (surface.scale) {
        sculpture.mm_per_unit = surface.scale->mm_per_unit;
        sculpture.mm_per_deg = surface.scale->mm_per_deg;
    }
    if (maps) {
        sculpture.mesh = std::make_shared<const Mesh>(maps->mesh());
        sculpture.part_names = maps->mesh().part_names;
        if (surface.scale)
            surface.geometry = std::make_unique<SurfaceGeometry>(*sculpture.mesh, surface.scale->mm_per_unit);
        else
            surface.geometry = std::make_unique<SurfaceGeometry>(*sculpture.mesh);
        if (surface.scale) {
            surface.coarse = std::make_unique<CoarseSurface>(*surface.geometry, coarse_nodes);
            surface.coarse_geometry = std::make_unique<SurfaceGeometry>(surface.coarse->mesh());
        }
        surface.areas_mm2 = surface.geometry->vertex_areas_mm2();
    }
    if (sculpture.remark.empty() && !sculpture.head)
        sculpture.remark = fmt::format("{} has no part \"head\": there is no fraction of it.", sculpture.id);
}

} // namespace overt
