#include "experiment/study/read/object_surface.h"

#include <fmt/format.h>

#include "experiment/maps/coordinate_maps.h"

namespace overt {

void add_surface(const SurfaceLookup* lookup, const std::string& fault, StudyObject& object,
                 ObjectSurface& surface) {
    surface.scale = object_scale(object.camera, object.axis_point, object.screen, object.unit);
    const auto* maps = dynamic_cast<const CoordinateMaps*>(lookup);
    if (!lookup)
        object.remark = fault.empty()
                            ? fmt::format("The sessions have no maps of {}: gaze on it has no place on "
                                          "a surface, and is not counted.",
                                          object.id)
                            : fmt::format("The maps of {} cannot be used, so its gaze is not counted: {}",
                                          object.id, fault);
    else if (!maps)
        object.remark = fmt::format("Of {} there are ready-made maps and no mesh: fixations have places "
                                    "but there are no maps on the surface.",
                                    object.id);
    else if (!surface.scale)
        object.remark = fmt::format("The camera or the screen of {} is not known: there are no "
                                    "millimetres, and no maps.",
                                    object.id);
    if (surface.scale) {
        object.mm_per_unit = surface.scale->mm_per_unit;
        object.mm_per_deg = surface.scale->mm_per_deg;
        object.shown_size = surface.scale->shown_size;
    }
    if (maps) {
        object.mesh = std::make_shared<const Mesh>(maps->mesh());
        object.part_names = maps->mesh().part_names;
        object.areas = Areas(object.part_names);
        if (surface.scale)
            surface.geometry = std::make_unique<SurfaceGeometry>(*object.mesh, surface.scale->mm_per_unit);
        else
            surface.geometry = std::make_unique<SurfaceGeometry>(*object.mesh);
        if (surface.scale) {
            surface.coarse =
                std::make_unique<CoarseSurface>(*surface.geometry, coarse_nodes, surface.scale->shown_size);
            surface.coarse_geometry = std::make_unique<SurfaceGeometry>(surface.coarse->mesh());
        }
        surface.areas_mm2 = surface.geometry->vertex_areas_mm2();
    }
    if (object.remark.empty() && object.areas.empty())
        object.remark = fmt::format("{} has no named areas: there are no shares of its parts.", object.id);
}

} // namespace overt
