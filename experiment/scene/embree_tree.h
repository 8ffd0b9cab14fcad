/// Embree's tree of a mesh whose triangles the program itself looks at, in double precision. Only for files
/// that ask it; nothing of Embree is in other headers.
#pragma once

#include <cstddef>
#include <memory>

#include <embree3/rtcore.h>

#include "experiment/scene/mesh.h"

namespace overt {

class EmbreeTree {
  public:
    /// Throws GraphicsError if Embree refuses.
    EmbreeTree();

    /// A geometry of so many boxes, for the caller to set its functions; build() takes it.
    RTCGeometry user_geometry(std::size_t boxes);
    /// Makes the tree. Throws GraphicsError, which says that Embree cannot do `what`, if it refuses.
    void build(RTCGeometry geometry, const char* what);
    RTCScene scene() const { return scene_.get(); }

  private:
    struct Release {
        void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
        void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
    };
    std::unique_ptr<RTCDeviceTy, Release> device_;
    std::unique_ptr<RTCSceneTy, Release> scene_;
};

/// The box of a triangle less `centre`, in the tree's floats, wider by `margin` on each side.
RTCBounds box_of(const Mesh& mesh, std::size_t triangle, const glm::dvec3& centre, double margin);

/// A position is rounded to float for the tree: that moves it by at most 2^-24 of the radius of the sphere
/// that holds all coordinates, and a ray by a quarter of a millionth of it in all. Boxes and limits are
/// widened by more.
inline constexpr double tree_widening = 2e-6;

} // namespace overt
