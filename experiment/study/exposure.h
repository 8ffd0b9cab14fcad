/// What of a sculpture a presentation shows, and for how long: the baseline of gaze that looks at all of the
/// picture alike.
#pragma once

#include <vector>

#include "experiment/animation.h"
#include "experiment/maps/coordinate_maps.h"

namespace overt {

struct Exposure {
    /// By vertex: see StudySculpture. A vertex counts as visible where one of its triangles is at the centre
    /// of a pixel.
    std::vector<float> seconds_visible;
    /// By vertex: seconds times pixels of the picture that show its triangles, shared among their corners.
    /// How long a place was visible, how large it was and how obliquely it was seen are all in it.
    std::vector<double> pixel_seconds;
};

/// Of one presentation as it was planned. Uses all processors; does not depend on how many.
Exposure exposure_of(const CoordinateMaps& maps, const Animation& animation, const PoseTable& poses);

} // namespace overt
