#include "render/stimulus/scene_view.h"

#include <glm/gtc/matrix_transform.hpp>

namespace overt {

glm::mat4 clip_from_centred_object(const SceneView& scene, const ObjectPose& object) {
    const DepthRange depths = depth_range(scene.bounds, scene.view, object);
    const glm::dmat4 upside_down = glm::scale(glm::dmat4(1.0), glm::dvec3(1.0, -1.0, 1.0));
    const glm::dmat4 object_from_centred = glm::translate(glm::dmat4(1.0), scene.bounds.centre());
    return glm::mat4(upside_down * scene.view.clip_from_view(depths.near, depths.far) *
                     scene.view.view_from_world() * scene.pose_at(object).world_from_object() *
                     object_from_centred);
}

} // namespace overt
