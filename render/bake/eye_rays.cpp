#include "render/bake/eye_rays.h"

#include <algorithm>
#include <cmath>

namespace overt {

EyeRays::EyeRays(const SceneView& scene, const ObjectPose& angle, glm::dvec3 centre, double radius)
    : radius_(radius) {
    const View& view = scene.view;
    // The rows of the rotation are the camera's axes.
    const glm::dmat3 world_from_view = glm::transpose(glm::dmat3(view.view_from_world()));
    const double scale = 2.0 * std::tan(0.5 * to_radians(view.camera.vertical_fov).value) / view.image_px.y;
    const glm::dvec2 ahead_px = view.straight_ahead_px();
    const TurntablePose pose = scene.pose_at(angle);
    const auto turned_back = [&](glm::dvec3 direction) {
        return to_object({view.camera.eye(), direction}, pose).direction;
    };
    origin_ = to_object({view.camera.eye(), {0.0, 1.0, 0.0}}, pose).origin - centre;
    right_ = scale * turned_back(world_from_view[0]);
    down_ = -scale * turned_back(world_from_view[1]);
    corner_ = -turned_back(world_from_view[2]) - ahead_px.x * right_ - ahead_px.y * down_;
}

PathRay EyeRays::through(glm::dvec2 image_point_px) const {
    const glm::dvec3 direction =
        glm::normalize(corner_ + image_point_px.x * right_ + image_point_px.y * down_);
    const double moved = std::max(0.0, -glm::dot(origin_, direction) - radius_);
    return {glm::vec3(origin_ + moved * direction), glm::vec3(direction)};
}

} // namespace overt
