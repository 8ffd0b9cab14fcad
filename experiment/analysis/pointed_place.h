/// A place of the screen that an observer pointed at, as a place on the object: with what was not exact about
/// the pointing, carried onto the surface.
#pragma once

#include <array>
#include <optional>

#include <glm/glm.hpp>

#include "experiment/maps/sight_lines.h"
#include "experiment/maps/surface_point.h"
#include "experiment/screen_geometry.h"

namespace overt {

/// A covariance in the picture, in px², of x to the right and y down; symmetric.
///
/// Of a mouse's pointer: it is somewhere within its pixel with equal chance, so 1/12 px² on both axes.
glm::dmat2 covariance_of_pixel();

/// Of gaze whose error is normal with the same standard deviation to all sides in visual angle (see
/// GazeCone). At a place r mm from the eye on a flat screen at the distance D, an angle covers r² / D mm of
/// the screen away from its middle, and r mm across that.
glm::dmat2 covariance_of_gaze(const ScreenGeometry& screen, ScreenPoint gaze, Degrees sigma);

/// How far on the surface pointing may have been off, to the first order: the surface is taken for the plane
/// of the triangle that was met. Where the surface bends within the footprint, and at silhouettes, where the
/// plane is seen edge on, it is too simple; cones of gaze (GazeCone) are for that.
///
/// A line of sight o + t d(x, y) meets the plane through p with the normal n at t = n·(p - o) / n·d. Along it
/// dt/dx = -t (n·dx) / (n·d), where dx is how d changes from pixel to pixel, so that the place moves by
///     J = t (dx - d (n·dx) / (n·d)),
/// and likewise along y: both lie in the plane. The covariance on the surface is J C Jᵀ of the one in the
/// picture, C.
struct SurfaceFootprint {
    glm::dmat3 covariance{0.0}; ///< in the square of the mesh's unit; of rank 2: nothing along the normal
    double largest_sd = 0.0;    ///< along the longer axis of the ellipse of one standard deviation
    double smallest_sd = 0.0;   ///< along its shorter one
};

/// `corners`: of the triangle, in object coordinates. `covariance_px`: in the picture, which is shown pixel
/// by pixel. Nothing for a triangle without an area, or that is seen exactly edge on.
std::optional<SurfaceFootprint> footprint_of(const SightLines& lines, glm::dvec2 image_point_px,
                                             const std::array<glm::dvec3, 3>& corners,
                                             const glm::dmat2& covariance_px);

/// Of a triangle of a mesh.
std::array<glm::dvec3, 3> corners_of(const Mesh& mesh, std::uint32_t triangle);

} // namespace overt
