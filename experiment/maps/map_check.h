/// How far a coordinate-encoded map is from the truth: rays cast through the pixel centres in double
/// precision.
#pragma once

#include "experiment/maps/coordinate_codec.h"
#include "experiment/maps/coordinate_image.h"
#include "experiment/scene/ray_caster.h"

namespace overt {

/// Errors of many pixels. One pixel's error is that of its worst axis, in LSB: the extent of the bounding box
/// on that axis / 65536.
struct MapErrors {
    double mean_lsb = 0.0;
    double p99_9_lsb = 0.0; ///< 99.9 % of the pixels have less
    double max_lsb = 0.0;
};

struct MapCheck {
    int covered_px = 0;          ///< by the rays
    int coverage_differs_px = 0; ///< covered by the map or by the rays, but not by both
    /// Pixels away from edges: the rays meet the object in all of the 3 x 3 pixels around, with neighbours at
    /// distances that differ by at most 1 % of the bounding box's diagonal.
    int interior_px = 0;
    MapErrors as_float; ///< of the map itself, in the interior
    MapErrors as_codes; ///< of the map once coded with 16 bits and decoded, in the interior
    /// What rounding to the nearest code does to the very places that the rays meet, in the interior: a mean
    /// that no sound map can be expected to come below. See excess_lsb.
    double rounding_mean_lsb = 0.0;
    /// By how much the mean of as_codes exceeds rounding_mean_lsb.
    ///
    /// Where a surface lies at random to the codes, a pixel's rounding error is the largest of three that are
    /// uniform within half a code: of mean 3/8 and standard deviation sqrt(0.15 - 9/64) = 0.0968, so that the
    /// mean of n pixels scatters by 0.0968/sqrt(n) and exceeds 3/8 + 4.75 * 0.0968/sqrt(n) once in a million
    /// sound maps; but a face along an axis has one error all over, and no such bound. Compared with the
    /// rounding errors of the same pixels, neither matters: if c is the code nearest to x, and c' that
    /// nearest to x + d, then |c' - x| <= |c' - x - d| + |d| <= |c - x - d| + |d| <= |c - x| + 2 |d|. So the
    /// excess of a sound coder is at most twice the mean error of the map itself, on every mesh and at every
    /// size: with that bound no sound map ever fails.
    double excess_lsb = 0.0;
    /// Largest distance between a covered pixel's place and the surface, as share of the diagonal, edges
    /// included. An upper bound where the pixel shows another surface than the ray meets.
    double farthest_off_surface = 0.0;
};

/// Checks a map of a mesh in a pose. `rays` are those of the mesh. Works on all processors. Throws InputError
/// if the map has another size than the view.
MapCheck check_map(const CoordinateImage& map, const RayCaster& rays, const SceneView& scene,
                   const ObjectPose& angle, int scale = CoordinateCodec::usual_scale);

/// The worse of each figure of two maps; the pixels counted are summed.
MapCheck worst_of(const MapCheck& one, const MapCheck& other);

} // namespace overt
