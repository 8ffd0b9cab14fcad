#include "experiment/study/read/sculpture_surface.h"

#include <fmt/format.h>

#include "experiment/maps/coordinate_maps.h"

namespace overt {

void add_surface(const SurfaceLookup* lookup, const std::string& fault, StudySculpture& sculpture,
                 SculptureSurface& surface) {
    surface.scale = object_scale(sculpture.camera, sculpture.axis_point, sculpture.screen, sculpture.unit);
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
        sculpture.shown_size = surface.scale->shown_size;
    }
    if (maps) {
        sculpture.mesh = std::make_shared<const Mesh>(maps->mesh());
        sculpture.part_names = maps->mesh().part_names;
        if (surface.scale)
            surface.geometry = std::make_unique<SurfaceGeometry>(*sculpture.mesh, surface.scale->mm_per_unit);
        else
            surface.geometry = std::make_unique<SurfaceGeometry>(*sculpture.mesh);
        if (surface.scale) {
            surface.coarse =
                std::make_unique<CoarseSurface>(*surface.geometry, coarse_nodes, surface.scale->shown_size);
            surface.coarse_geometry = std::make_unique<SurfaceGeometry>(surface.coarse->mesh());
        }
        surface.areas_mm2 = surface.geometry->vertex_areas_mm2();
    }
    if (sculpture.remark.empty() && !sculpture.head)
        sculpture.remark = fmt::format("{} has no part \"head\": there is no fraction of it.", sculpture.id);
}

} // namespace overt
