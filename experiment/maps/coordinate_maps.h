/// The coordinate-encoded look-up tables of one object: from a place in the image to a point on the
/// surface.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "experiment/maps/pose_cells.h"
#include "experiment/maps/sight_lines.h"
#include "experiment/maps/surface_point.h"
#include "experiment/maps/surface_walk.h"
#include "experiment/maps/triangle_map.h"
#include "experiment/scene/ray_caster.h"
#include "experiment/scene/viewing.h"

namespace overt {

/// One map per distinct pose, with the mesh and camera they were drawn from.
///
/// A look-up is sub-pixel, and gives what casting a ray through the place gives. Where no contour of the mesh
/// touches the pixel, the map knows the one sheet of surface that is seen there: from the triangle at the
/// pixel's centre it is a step or two along the surface to the place itself, in double. In the few per cent
/// of pixels that a contour does touch, at silhouettes and where one part hides another, no map can know what
/// lies between the centres, and a ray is cast. What is left is a mesh that passes through itself between the
/// centres of neighbouring pixels without showing at either.
class CoordinateMaps final : public SurfaceLookup {
  public:
    /// For how many look-ups the maps are made ready. To find where contours touch pixels takes as long as
    /// about a million rays: for fewer look-ups each is a ray, which gives the same.
    enum class Use : std::uint8_t { many_lookups, few_lookups };

    /// `mesh` must outlive this; `angles` and `maps` by PoseIndex, equally long. Throws InputError if a map
    /// has another size than the view or names a triangle that the mesh does not have.
    CoordinateMaps(const Mesh& mesh, const SceneView& scene, const std::vector<ObjectPose>& angles,
                   std::vector<TriangleMap> maps, Use use = Use::many_lookups);

    /// The same from maps that are made one by one, so that never all of them are in memory: `map_of` is
    /// asked once for each pose, from several threads at once.
    CoordinateMaps(const Mesh& mesh, const SceneView& scene, const std::vector<ObjectPose>& angles,
                   const std::function<TriangleMap(PoseIndex)>& map_of, Use use = Use::many_lookups);

    std::optional<SurfacePoint> surface_at(PoseIndex pose, glm::dvec2 point_px) const override;
    void look(std::span<const ImagePlace> places, std::span<Sight* const> sights) const override;
    std::optional<PartIndex> part_near(PoseIndex pose, glm::dvec2 point_px) const override;
    /// By the mesh: walking along the surface from the one pixel's centre leads to the other's.
    bool goes_on(PoseIndex pose, glm::ivec2 pixel, glm::ivec2 neighbour) const override;

    const Mesh& mesh() const { return *mesh_; }
    const RayCaster& rays() const { return caster_; }
    glm::ivec2 image_px() const { return image_px_; }
    std::size_t pose_count() const { return cells_.size(); }
    const PoseCells& cells(PoseIndex pose) const { return cells_[static_cast<std::size_t>(pose.value)]; }
    const SightLines& sight_lines(PoseIndex pose) const {
        return sight_lines_[static_cast<std::size_t>(pose.value)];
    }
    /// A point of the surface is in the image and nothing hides it.
    bool is_visible(PoseIndex pose, glm::dvec3 object_point) const;

    /// The same as ever was given.
    TriangleMap map(PoseIndex pose) const { return cells(pose).map(); }

  private:
    bool is_in_image(glm::dvec2 point_px) const {
        // Also turns away what is not a number.
        return point_px.x >= 0.0 && point_px.y >= 0.0 && point_px.x < image_px_.x && point_px.y < image_px_.y;
    }
    // Results are written where they will stay: they are so large that copying them would take as long as
    // finding them.
    bool meet(PoseIndex pose, PixelCell cell, const glm::dvec3& direction, Meeting& meeting) const;
    bool cast(const SightLines& lines, const glm::dvec3& direction, Meeting& meeting) const;
    void find_surface(const ImagePlace& place, std::optional<SurfacePoint>& surface) const;
    void fetch_cell(const ImagePlace& place) const;
    void fetch_triangle(const ImagePlace& place) const;

    const Mesh* mesh_;
    glm::ivec2 image_px_;
    SurfaceWalk walk_;
    RayCaster caster_;
    std::vector<SightLines> sight_lines_;
    std::vector<PoseCells> cells_;
};

} // namespace overt
