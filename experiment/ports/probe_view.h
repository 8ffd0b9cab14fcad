/// The port of a place on the surface of the object that is shown: where a probe stands.
#pragma once

#include <glm/glm.hpp>

#include "experiment/animation.h"
#include "experiment/attitude.h"
#include "experiment/units.h"

namespace overt {

/// The place in one frame. Lengths are in the mesh's unit; the eye of the camera is the origin, x points to
/// the right, y up and z towards the viewer, so that what is seen has a negative z.
struct SeenProbe {
    glm::dvec3 position{0.0, 0.0, -1.0};
    glm::dvec3 normal{0.0, 0.0, 1.0}; ///< of the triangle, unit length, outwards
    bool is_visible = false; ///< in the image, on the side that is seen, and no other surface hides it

    /// How the surface is turned from its own line of sight.
    Attitude attitude() const { return attitude_of(glm::transpose(frame_of_sight(position)) * normal); }
};

/// One place of one object, as its stimulus is seen in its slot. On the session's thread.
class ProbeView {
  public:
    virtual ~ProbeView() = default;
    /// In a frame of the stimulus's motion. Called between a presentation's first and last flip: allocates
    /// and throws nothing.
    virtual SeenProbe seen_in(AnimationFrameIndex frame) const noexcept = 0;

    /// Where such a position is seen on the screen. Meaningless unless z is negative.
    ScreenPoint on_screen(const glm::dvec3& position) const noexcept {
        const double scale = px_at_unit_depth / -position.z;
        return {middle.x_px + scale * position.x, middle.y_px - scale * position.y};
    }
    /// The same in the other eye's picture, where it has one of its own (View::other_eye_right_px).
    ScreenPoint in_other_eye(const glm::dvec3& position) const noexcept {
        const ScreenPoint own = on_screen(position);
        const double right_px = 2.0 * px_at_unit_depth * aside * (1.0 / -position.z - 1.0 / target_depth);
        return {own.x_px + right_px, own.y_px};
    }
    ScreenPoint middle;            ///< where the camera looks straight ahead
    double px_at_unit_depth = 1.0; ///< pixels that a unit of length takes in a depth of one
    double aside = 0.0;            ///< how far the eye stands to the right of the middle of both
    double target_depth = 1.0;     ///< in which both eyes see a place alike
};

} // namespace overt
