/// What of a sculpture a presentation shows, and for how long: the baseline of gaze that looks at all of the
/// picture alike.
#pragma once

#include <vector>

#include "experiment/animation.h"
#include "experiment/maps/coordinate_maps.h"

namespace overt {

struct Exposure {
    std::vector<float> seconds_visible; ///< by vertex: see StudySculpture
    /// By vertex: seconds times pixels of the picture that lie nearest to it (shared among a triangle's
    /// corners by barycentric weights). How long a place was visible, how large it was and how obliquely it
    /// was seen are all in it, since it counts the pixels it took.
    std::vector<double> pixel_seconds;
    std::vector<double> depth; ///< by vertex: mean depth of these pixels; 0 without
};

/// Of one presentation as it was planned. Uses all processors; does not depend on how many.
Exposure exposure_of(const CoordinateMaps& maps, const Animation& animation, const PoseTable& poses);

} // namespace overt
