/// The rays that a picture's places are seen along, in the coordinates of a BakeScene.
#pragma once

#include <glm/glm.hpp>

#include "experiment/scene/viewing.h"
#include "render/bake/surface_tree.h"

namespace overt {

/// Does what SceneView and to_object do, once for a picture instead of once for a ray.
class EyeRays {
  public:
    /// Rays about `centre`, from the edge of a sphere of `radius` around it on: a float is too coarse for the
    /// camera's distance.
    EyeRays(const SceneView& scene, const ObjectPose& angle, glm::dvec3 centre, double radius);

    /// Through a continuous image point.
    PathRay through(glm::dvec2 image_point_px) const;

  private:
    glm::dvec3 origin_{0.0}; ///< the eye, about the centre, with the object as it stands unturned
    glm::dvec3 corner_{0.0}, right_{0.0},
        down_{0.0}; ///< direction to the picture's corner, and what a pixel adds
    double radius_ = 0.0;
};

} // namespace overt
