/// Cloth: folds drawn on the garments' surface, hems and rolls. Coordinates and lengths in mm.
#pragma once

#include <vector>

#include "experiment/scene/sculptures/clay.h"

namespace overt {

/// A ridge of cloth.
struct Fold {
    std::vector<glm::dvec3>
        path;              ///< at least 3 points near the surface; the ridge is a smooth curve along them
    double width_at_start; ///< from the crest to the foot on one side
    double width_at_end;
    double height;
    double fade_in = 0.25;  ///< share of the length over which it rises
    double fade_out = 0.25; ///< share over which it sinks; 0 ends bluntly, as at a hem
};

/// The relief of many folds on `base`. Each path is first laid onto the surface. Where folds meet, the fourth
/// root of their heights' fourth powers counts: the higher one covers the other, with a soft valley between.
Relief fold_relief(const Clay& base, const std::vector<Fold>& folds);

/// Points of a garment at the given heights, seen from a vertical axis: angles in degrees, 0 to the front
/// (-y) and 90 to the figure's left (+x), run evenly from `angle_top` to `angle_bottom`.
std::vector<glm::dvec3> falling_path(const Clay& base, const glm::dvec2& axis, double angle_top_deg,
                                     double z_top, double angle_bottom_deg, double z_bottom);

/// Path through a few given points, along a Catmull-Rom curve.
std::vector<glm::dvec3> hanging_path(const std::vector<glm::dvec3>& points);

/// Everything on the side of the plane through `point` that `outwards` points away from.
Shape half_space(const glm::dvec3& point, const glm::dvec3& outwards);

/// The part of `a` that lies in `b` too, its edge rounded.
Shape common(Shape a, Shape b, double blend_mm);

/// A roll of cloth along the path: a bundle of strands that wind about each other.
Clay twisted_roll(const std::vector<glm::dvec3>& path, double radius, int strands, double turns);

} // namespace overt
