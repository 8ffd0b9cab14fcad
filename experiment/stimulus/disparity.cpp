#include "experiment/stimulus/disparity.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace overt {

std::optional<DisparityRange> disparity_of(const Object& object, const Protocol& protocol) {
    if (!protocol.stereo.is_on() || !object.has_mesh())
        return std::nullopt;
    const std::vector<glm::vec3> normals = object.mesh->vertex_normals();
    const ScreenGeometry screen = screen_geometry_of(protocol);
    const double arcmin_per_px =
        60.0 * to_degrees({screen.screen_mm.x / screen.screen_px.x / screen.viewing_distance_mm}).value;
    double nearest_px = -std::numeric_limits<double>::infinity(), farthest_px = nearest_px;
    // The right eye's views are behind the left eye's.
    for (std::size_t index = 0; index < object.scenes.size() / 2; ++index) {
        const SceneView& scene = object.scenes[index];
        const glm::dvec3 eye = scene.view.camera.eye();
        for (const Animation& motion : protocol.motions)
            for (const Pose& pose : motion.pictures()) {
                const glm::dmat4 world_from_object = scene.pose_at(pose.object).world_from_object();
                const glm::dmat3 turn(world_from_object);
                double near = std::numeric_limits<double>::infinity(), far = 0.0;
                for (std::size_t i = 0; i < normals.size(); ++i) {
                    const glm::dvec3 at(world_from_object * glm::dvec4(object.mesh->positions[i], 1.0));
                    if (glm::dot(turn * glm::dvec3(normals[i]), eye - at) <= 0.0)
                        continue;
                    const double depth = scene.view.depth_of(at);
                    near = std::min(near, depth);
                    far = std::max(far, depth);
                }
                if (near > far || near <= 0.0)
                    continue;
                const auto right_px = [&](double depth) {
                    const Camera& camera = scene.view.camera;
                    return scene.view.other_eye_right_px(
                        camera.position + depth * glm::normalize(camera.target - camera.position));
                };
                nearest_px = std::max(nearest_px, -right_px(near));
                farthest_px = std::max(farthest_px, right_px(far));
            }
    }
    if (!std::isfinite(nearest_px))
        return std::nullopt;
    return DisparityRange{nearest_px * arcmin_per_px, farthest_px * arcmin_per_px};
}

} // namespace overt
