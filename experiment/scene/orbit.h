/// From where an object is looked at when it is turned by hand.
#pragma once

#include <glm/glm.hpp>

#include "experiment/scene/viewing.h"

namespace overt {

/// From where an object is looked at, beside what its protocol says.
struct Orbit {
    double turn_deg = 0.0;      ///< of the turntable, counter-clockwise seen from above
    double elevation_deg = 0.0; ///< of the camera about its target, -85 … 85
    double distance = 1.0;      ///< factor to the camera's

    /// By a drag of the mouse: half a degree for each pixel, as if the surface were held.
    void drag(glm::dvec2 by_px);
    /// By steps of the wheel, a tenth each; nearer for positive ones.
    void zoom(double steps);
};

/// The same scene looked at from elsewhere. A camera that came into the space which the turning object
/// sweeps is put just outside of it.
SceneView seen_from(const SceneView& scene, const Orbit& orbit);

} // namespace overt
