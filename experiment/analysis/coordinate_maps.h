/// The coordinate-encoded look-up tables of one sculpture: from a place in the image to a point on the
/// surface.
#pragma once

#include <array>
#include <vector>

#include "experiment/analysis/surface_point.h"
#include "experiment/analysis/triangle_map.h"
#include "experiment/scene/viewing.h"

namespace overt {

/// One map per distinct pose, with the mesh and camera they were drawn from.
///
/// A look-up is sub-pixel: the sight line through the place itself is met, in double, with the triangles that
/// the map shows in the 3 x 3 pixels around it and, where it passes beside them, with their neighbours across
/// the edges crossed. The nearest meeting counts.
class CoordinateMaps final : public SurfaceLookup {
  public:
    /// `mesh` must outlive this; `angles` and `maps` by PoseIndex, equally long. Throws InputError if a map
    /// has another size than the view or names a triangle that the mesh does not have.
    CoordinateMaps(const Mesh& mesh, const SceneView& scene, std::vector<Degrees> angles,
                   std::vector<TriangleMap> maps);

    std::optional<SurfacePoint> surface_at(PoseIndex pose, glm::dvec2 image_point_px) const override;

    const TriangleMap& map(PoseIndex pose) const { return maps_[static_cast<std::size_t>(pose.value)]; }
    std::size_t pose_count() const { return maps_.size(); }

  private:
    /// Sight lines of one pose in object coordinates: origin + t (forward + x right + y down), t = depth.
    struct SightLines {
        glm::dvec3 origin, forward, right_per_px, down_per_px;
    };
    /// Where a sight line passes a triangle's plane.
    struct Meeting {
        std::uint32_t triangle;
        glm::dvec3 barycentric;
        double depth;
    };

    std::optional<Meeting> walk(std::uint32_t triangle, glm::dvec3 origin, glm::dvec3 direction) const;

    const Mesh* mesh_;
    SceneView scene_;
    std::vector<SightLines> sight_lines_;
    std::vector<TriangleMap> maps_;
    std::vector<std::array<std::uint32_t, 3>>
        neighbours_; ///< triangle opposite each corner; no_triangle at a border
};

} // namespace overt
