/// From a place in the image to a point on the surface, where nothing is known of the surface but its
/// coordinate-encoded maps.
#pragma once

#include <functional>
#include <vector>

#include "experiment/maps/coordinate_image_file.h"
#include "experiment/maps/pose_cells.h"
#include "experiment/maps/sight_lines.h"
#include "experiment/maps/surface_point.h"

namespace overt {

/// Ready-made maps, one for each distinct pose.
///
/// Whether a place is on the object is decided by its pixel. Between pixel centres the position is
/// interpolated, but only with neighbours that belong to the same patch of surface: across an edge it would
/// be a place in mid-air. Neighbours belong together if the step between them is at most three times the
/// map's median step, or twice the step that follows it on either side, as on a steep flank. Where a
/// neighbour is missing the slope on the other side goes on to the place; where both are, the pixel's own
/// position stands.
///
/// Of a point found here the triangle is `no_triangle` and the barycentric weights are 0. Depth and incidence
/// are not a number unless the map says where the camera stood and how the object was turned (a description
/// with camera, bounds and angle); the incidence is that of the slope of the map.
class CoordinateImageLookup final : public SurfaceLookup {
  public:
    /// `maps` by PoseIndex. Throws InputError if one has another size than `image_px`.
    CoordinateImageLookup(std::vector<CoordinateImageFile> maps, glm::ivec2 image_px);

    /// The same from maps that are read one by one, for they are large: `map_of` is asked once for each of
    /// the `poses`, from several threads at once.
    CoordinateImageLookup(std::size_t poses, const std::function<CoordinateImageFile(PoseIndex)>& map_of,
                          glm::ivec2 image_px);

    std::optional<SurfacePoint> surface_at(PoseIndex pose, glm::dvec2 point_px) const override;
    void look(std::span<const ImagePlace> places, std::span<Sight* const> sights) const override;

    /// By the steps of the map, as above.
    bool goes_on(PoseIndex pose, glm::ivec2 pixel, glm::ivec2 neighbour) const override {
        return belong_together(patches_[static_cast<std::size_t>(pose.value)], pixel, neighbour - pixel);
    }

    std::size_t pose_count() const { return patches_.size(); }
    glm::ivec2 image_px() const { return image_px_; }

  private:
    /// The covered pixels of a map; the cell of each has its number in place of a triangle's.
    struct Patches {
        PoseCells cells;
        std::vector<glm::vec3> places;
        std::vector<PartIndex> parts; ///< empty if not known
        double usual_step = 0.0;      ///< median between neighbouring pixels
        std::optional<SightLines> sight;
    };
    /// Slopes of the position at a place, per pixel; 0 where no neighbour tells.
    struct Slopes {
        glm::dvec3 right{0.0}, down{0.0};
    };

    static Patches patches_of(const CoordinateImageFile& map, glm::ivec2 image_px);
    static const glm::vec3* place_of(const Patches& patches, glm::ivec2 pixel);
    static bool belong_together(const Patches& patches, glm::ivec2 pixel, glm::ivec2 step);
    static glm::dvec3 slope_along(const Patches& patches, glm::ivec2 pixel, glm::ivec2 step);
    static std::optional<double> incidence_rad(const Patches& patches, const Slopes& slopes,
                                               glm::dvec2 image_point_px);

    glm::ivec2 image_px_;
    std::vector<Patches> patches_;
};

} // namespace overt
