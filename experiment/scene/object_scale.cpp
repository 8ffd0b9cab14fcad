#include "experiment/scene/object_scale.h"

#include <cmath>

namespace overt {

std::optional<ObjectScale> object_scale(const Camera& camera, const glm::dvec3& axis_point,
                                        const ScreenGeometry& screen, std::string_view unit) {
    const double fov = to_radians(camera.vertical_fov).value;
    if (!(fov > 0.0) || !(screen.viewing_distance_mm > 0.0) || screen.screen_px.y <= 0 ||
        !(screen.screen_mm.y > 0.0))
        return std::nullopt;
    const double axis_depth =
        View{camera, screen.image_px}.depth_of({axis_point.x, axis_point.y, camera.target.z});
    if (!(axis_depth > 0.0))
        return std::nullopt;
    const double display_mm_per_px = screen.screen_mm.y / screen.screen_px.y;
    const double display_mm_per_unit =
        screen.image_px.y * display_mm_per_px / (2.0 * std::tan(0.5 * fov) * axis_depth);
    const double mm_per_unit = unit == "mm" ? 1.0 : display_mm_per_unit;
    const double shown_size = display_mm_per_unit / mm_per_unit;
    const double display_mm_per_deg = screen.viewing_distance_mm * std::tan(to_radians(Degrees{1.0}).value);
    return ObjectScale{mm_per_unit, axis_depth, display_mm_per_deg / shown_size, shown_size};
}

} // namespace overt
