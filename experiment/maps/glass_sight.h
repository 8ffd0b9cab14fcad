/// Where a line of sight through a body of polished glass comes to the far side of its surface.
#pragma once

#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include "experiment/maps/coordinate_image.h"
#include "experiment/maps/coordinate_maps.h"
#include "experiment/maps/surface_point.h"
#include "experiment/scene/shading_normals.h"

namespace overt {

/// The place of the far side that is looked at through glass.
struct FarPoint {
    /// `depth` as of each point; `incidence` between the line of sight inside and the surface's normal.
    SurfacePoint surface;
    int reflections = 0; ///< total ones, on the way to it
};

/// How often a line of sight may be reflected totally before it counts as lost.
inline constexpr int most_total_reflections = 8;

/// Follows lines of sight into a body as light would go the other way: bent by Snell's law where they enter,
/// mirrored where they meet the surface from inside so flatly that nothing leaves there. Where one would
/// leave is its far point. That is one of the many ways that the light of a place takes, the one that carries
/// most of it where it is not steep; a part of each is mirrored at each surface. Bent at the normals that
/// frames are lit by (corner_normals), in double precision: the far points are those of the picture's paths.
/// Asked from any number of threads.
class GlassSight {
  public:
    /// `maps` must outlive this. `index`: of the body's glass, to air, at 587.6 nm; at least 1.
    GlassSight(const CoordinateMaps& maps, double index);

    /// `front` is what the maps show at a place in a pose. Nothing where the line does not leave within
    /// most_total_reflections, or the mesh is open.
    std::optional<FarPoint> far_point(PoseIndex pose, const SurfacePoint& front) const;

    /// As coordinate_image() has the front: what is seen through the centre of each pixel.
    CoordinateImage image(PoseIndex pose) const;

  private:
    /// At a place of a triangle: the normal that light is bent at, and the triangle's own.
    struct Normals {
        glm::dvec3 bent_at, own;
    };
    Normals normals_at(std::uint32_t triangle, const glm::dvec3& barycentric) const;

    const CoordinateMaps* maps_;
    double index_, step_off_;
    std::vector<CornerNormals> normals_;
};

} // namespace overt
