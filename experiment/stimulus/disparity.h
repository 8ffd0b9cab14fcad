/// How far apart two eyes see what is in front of the screen and behind it.
#pragma once

#include <optional>

#include "experiment/stimulus/object.h"

namespace overt {

/// Of all that can be seen of an object, turned towards the eyes, in all motions and views: in minutes of arc
/// from the plane of the screen, where there is none.
struct DisparityRange {
    double nearest_arcmin = 0.0;  ///< crossed: this much before the screen's plane; < 0: all is behind it
    double farthest_arcmin = 0.0; ///< uncrossed: this much behind it; < 0: all is before it
    double most() const { return std::max(nearest_arcmin, farthest_arcmin); }
};

/// Nothing without [stereo], or without a mesh.
std::optional<DisparityRange> disparity_of(const Object& object, const Protocol& protocol);

} // namespace overt
