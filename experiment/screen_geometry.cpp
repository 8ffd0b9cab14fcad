#include "experiment/screen_geometry.h"

#include <cmath>

namespace overt {

Degrees ScreenGeometry::angle_between(ScreenPoint a, ScreenPoint b) const {
    const glm::dvec2 mm_per_px = screen_mm / glm::dvec2(screen_px);
    const auto direction = [&](ScreenPoint point) {
        return glm::dvec3((point.x_px - centre().x_px) * mm_per_px.x,
                          (point.y_px - centre().y_px) * mm_per_px.y, viewing_distance_mm);
    };
    const glm::dvec3 to_a = direction(a), to_b = direction(b);
    // atan2 of sine and cosine, both times the same lengths, keeps its accuracy at small angles, where acos
    // loses it.
    return to_degrees({std::atan2(glm::length(glm::cross(to_a, to_b)), glm::dot(to_a, to_b))});
}

glm::dvec2 ScreenGeometry::middle_deg() const {
    const glm::dvec2 off_px = glm::dvec2(image_origin_px) + 0.5 * glm::dvec2(image_px - screen_px);
    const glm::dvec2 off_mm = off_px * screen_mm / glm::dvec2(screen_px);
    return {to_degrees({std::atan2(off_mm.x, viewing_distance_mm)}).value,
            to_degrees({std::atan2(-off_mm.y, viewing_distance_mm)}).value};
}

double ScreenGeometry::px_per_deg_at_centre() const {
    return std::tan(to_radians({1.0}).value) * viewing_distance_mm * screen_px.x / screen_mm.x;
}

glm::ivec2 centred_origin_px(glm::ivec2 screen_px, glm::ivec2 image_px) {
    const glm::ivec2 origin = (screen_px - image_px) / 2;
    return {origin.x & ~1, origin.y};
}

} // namespace overt
