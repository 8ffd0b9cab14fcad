/// A place on a sculpture's surface, as a gaze sample meets it.
#pragma once

#include <cstdint>
#include <optional>

#include <glm/glm.hpp>

#include "experiment/animation.h"
#include "experiment/scene/mesh.h"

namespace overt {

struct SurfacePoint {
    glm::dvec3 position{0.0};    ///< object coordinates, in the mesh's unit
    std::uint32_t triangle = 0;  ///< index into the mesh's triangles
    glm::dvec3 barycentric{0.0}; ///< weights of the triangle's corners, sum 1
    PartIndex part = 0;
    double depth = 0.0; ///< along the viewing direction, in the mesh's unit
    Degrees incidence;  ///< between the line of sight and the surface's normal, 0 = head-on
};

/// Finds what is seen at a place of a stimulus image in a given pose.
class SurfaceLookup {
  public:
    virtual ~SurfaceLookup() = default;
    /// `image_point_px` is continuous, see viewing.h. Nothing where the image shows no surface. May be called
    /// from any thread.
    virtual std::optional<SurfacePoint> surface_at(PoseIndex pose, glm::dvec2 image_point_px) const = 0;
};

} // namespace overt
