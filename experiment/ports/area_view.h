/// The port of an area of the object that is shown: what gaze is waited for.
#pragma once

#include "experiment/animation.h"
#include "experiment/units.h"

namespace overt {

/// One area of one object, as its stimulus is seen. On the session's thread.
class AreaView {
  public:
    virtual ~AreaView() = default;
    /// Whether the surface that is seen at a place of the screen, in a pose, belongs to the area. Called
    /// between a presentation's first and last flip: allocates and throws nothing.
    virtual bool is_at(PoseIndex pose, ScreenPoint place) const noexcept = 0;
};

} // namespace overt
