/// A place on an object's surface, as a gaze sample meets it, and the ways to find it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include <glm/glm.hpp>

#include "experiment/animation.h"
#include "experiment/gaze.h"
#include "experiment/scene/mesh.h"

namespace overt {

struct SurfacePoint {
    glm::dvec3 position{0.0};    ///< object coordinates, in the mesh's unit
    std::uint32_t triangle = 0;  ///< index into the mesh's triangles
    glm::dvec3 barycentric{0.0}; ///< weights of the triangle's corners, sum 1
    PartIndex part = 0;
    double depth = 0.0; ///< along the viewing direction, in the mesh's unit
    Degrees incidence;  ///< between the line of sight and the surface's normal, 0 = head-on
};

/// A continuous place of a stimulus image (see viewing.h), in a pose.
struct ImagePlace {
    PoseIndex pose;
    glm::dvec2 point_px{0.0};
};

/// What is seen at a place.
struct Sight {
    std::optional<SurfacePoint> surface; ///< nothing beside the object
    /// The place of the picture's outline that is nearest to it, in image pixels; nothing if that is not
    /// known, or if nothing of the object is in the image.
    std::optional<glm::dvec2> outline_px;
};

/// Finds what is seen at a place of a stimulus image in a given pose. All of it may be called from any
/// thread.
class SurfaceLookup {
  public:
    virtual ~SurfaceLookup() = default;

    /// Nothing where the image shows no surface, and outside of the image.
    virtual std::optional<SurfacePoint> surface_at(PoseIndex pose, glm::dvec2 image_point_px) const = 0;

    /// What is seen at each of many places, with the outline, written where the other span points to: faster
    /// than one by one. Both spans are equally long. Places outside of the image have no surface but an
    /// outline.
    virtual void look(std::span<const ImagePlace> places, std::span<Sight* const> sights) const {
        for (std::size_t i = 0; i < places.size(); ++i)
            *sights[i] = {surface_at(places[i].pose, places[i].point_px), std::nullopt};
    }

    /// The part seen at a place, where the pixel is answer enough: its centre may stand for the place.
    virtual std::optional<PartIndex> part_near(PoseIndex pose, glm::dvec2 image_point_px) const {
        const std::optional<SurfacePoint> surface = surface_at(pose, image_point_px);
        return surface ? std::optional(surface->part) : std::nullopt;
    }

    /// The surface at the centre of a pixel goes on to that of a neighbouring one: no edge lies between them
    /// across which one would step from one sheet of surface to another. False where either shows no surface.
    virtual bool goes_on(PoseIndex pose, glm::ivec2 pixel, glm::ivec2 neighbour) const = 0;
};

/// What each eye sees: the same, unless the eyes have pictures of their own. Null where there is no surface.
struct LookupsOfEyes {
    LookupsOfEyes() = default;
    LookupsOfEyes(const SurfaceLookup* both) : left(both), right(both) {}
    LookupsOfEyes(const SurfaceLookup* of_left, const SurfaceLookup* of_right)
        : left(of_left), right(of_right) {}
    const SurfaceLookup* of(Eye eye) const { return eye == Eye::left ? left : right; }

    const SurfaceLookup *left = nullptr, *right = nullptr;
};

} // namespace overt
