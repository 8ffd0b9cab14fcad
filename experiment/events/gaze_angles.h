/// From places on the screen to directions of gaze.
#pragma once

#include "experiment/screen_geometry.h"

namespace overt {

/// Directions of gaze, so that the length of a difference is an angle in degrees: exact for near places, and
/// within 0.2 % up to 13 degrees, which no saccade makes within a window of velocity.
class GazeAngles {
  public:
    /// The direction from the eye to each place: true everywhere on the screen.
    explicit GazeAngles(const ScreenGeometry& screen) : screen_(screen) {}

    /// Of a recording that says nothing of the screen: pixels per degree, as its tracker has them. Both more
    /// than 0.
    GazeAngles(double px_per_deg_x, double px_per_deg_y) : px_per_deg_(px_per_deg_x, px_per_deg_y) {}

    glm::dvec3 direction_deg(ScreenPoint place) const;

    /// True angle between two places, however far apart.
    double angle_deg(ScreenPoint a, ScreenPoint b) const;

  private:
    ScreenGeometry screen_{};
    glm::dvec2 px_per_deg_{0.0}; ///< 0: by the screen
};

} // namespace overt
