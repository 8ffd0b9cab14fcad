#include "experiment/events/gaze_angles.h"

namespace overt {

glm::dvec3 GazeAngles::direction_deg(ScreenPoint place) const {
    if (px_per_deg_.x > 0.0)
        return {place.x_px / px_per_deg_.x, place.y_px / px_per_deg_.y, 0.0};
    const ScreenPoint centre = screen_.centre();
    const glm::dvec2 mm_per_px = screen_.screen_mm / glm::dvec2(screen_.screen_px);
    const glm::dvec3 towards((place.x_px - centre.x_px) * mm_per_px.x,
                             (place.y_px - centre.y_px) * mm_per_px.y, screen_.viewing_distance_mm);
    return glm::normalize(towards) * to_degrees(Radians{1.0}).value;
}

double GazeAngles::angle_deg(ScreenPoint a, ScreenPoint b) const {
    if (px_per_deg_.x > 0.0)
        return glm::length(direction_deg(a) - direction_deg(b));
    return screen_.angle_between(a, b).value;
}

} // namespace overt
