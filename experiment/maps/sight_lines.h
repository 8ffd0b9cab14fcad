/// The lines of sight of one pose, in the coordinates of the unturned object.
#pragma once

#include <glm/glm.hpp>

#include "experiment/scene/viewing.h"

namespace overt {

/// The line through a continuous image point is origin + depth * direction_through(point), with the depth
/// along the viewing direction.
class SightLines {
  public:
    SightLines(const SceneView& scene, const ObjectPose& object);

    glm::dvec3 origin() const { return origin_; }

    /// Not of unit length: its component along the viewing direction is 1.
    glm::dvec3 direction_through(glm::dvec2 image_point_px) const {
        const glm::dvec2 off_centre = image_point_px - centre_px_;
        return forward_ + off_centre.x * right_per_px_ + off_centre.y * down_per_px_;
    }

    /// Image point (x, y) and depth (z) of a point of the object. Meaningless unless the depth is positive.
    glm::dvec3 project(glm::dvec3 object_point) const;

    /// What a pixel's width is at a depth, in the mesh's unit.
    double pixel_width_at(double depth) const { return depth / px_at_unit_depth_; }

  private:
    glm::dvec3 origin_, forward_, right_per_px_, down_per_px_;
    glm::dvec2 centre_px_;
    double px_at_unit_depth_;
};

} // namespace overt
