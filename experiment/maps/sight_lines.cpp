#include "experiment/maps/sight_lines.h"

#include <cmath>

namespace overt {

SightLines::SightLines(const SceneView& scene, const ObjectPose& object) {
    const View& view = scene.view;
    centre_px_ = view.straight_ahead_px();
    px_at_unit_depth_ = view.px_at_unit_depth();
    const glm::dmat4 view_from_object = view.view_from_world() * scene.pose_at(object).world_from_object();
    // Rows of the rotation are the camera's axes seen from the object.
    const glm::dmat3 object_from_view = glm::transpose(glm::dmat3(view_from_object));
    origin_ = object_from_view * -glm::dvec3(view_from_object[3]);
    forward_ = -object_from_view[2];
    right_per_px_ = object_from_view[0] / px_at_unit_depth_;
    down_per_px_ = -object_from_view[1] / px_at_unit_depth_;
}

glm::dvec3 SightLines::project(glm::dvec3 object_point) const {
    const glm::dvec3 from_origin = object_point - origin_;
    const double depth = glm::dot(from_origin, forward_);
    const double scale = px_at_unit_depth_ * px_at_unit_depth_ / depth;
    return {centre_px_.x + scale * glm::dot(from_origin, right_per_px_),
            centre_px_.y + scale * glm::dot(from_origin, down_per_px_), depth};
}

} // namespace overt
