/// Places on one object in a view that an observer may look at.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "devices/simulated/observed_scene.h"
#include "experiment/base/random.h"
#include "experiment/maps/surface_point.h"
#include "experiment/scene/ray_caster.h"

namespace overt {

/// Draws surface points and knows what is visible of them. Constant queries allocate nothing.
class GazeTargets {
  public:
    /// The object's mesh must outlive this and have triangles. Each effect of the scene has a spot on it,
    /// the same for all observers: a place that is seen at every angle of all motions, if there is one, and
    /// what of the surface lies within `spot_radius` of the mesh's height about it and faces the same way.
    GazeTargets(const ObservedObject& object, const ObservedScene& scene);
    static constexpr double spot_radius = 0.04;

    /// Regions are the scene's areas, by their index, and what is in none of them.
    std::size_t elsewhere() const noexcept { return regions_.size() - 1; }

    /// A point of the region, all of its area equally probable, save that the part "plinth" is looked at a
    /// tenth as often. An object without that region gives a point elsewhere, or of its first region.
    /// `spread`: see GazePlan; the usual distance is the root mean square one of all regions.
    SurfacePoint draw(RandomStream& random, std::size_t region, double spread = 0.0) const noexcept;

    /// The part on which an effect's spot lies.
    PartIndex part_of_spot(int effect) const noexcept {
        return spots_[static_cast<std::size_t>(effect)].middle.part;
    }
    /// A point of an effect's spot, all of its area equally probable.
    SurfacePoint draw_from_spot(RandomStream& random, int effect) const noexcept;

    /// Whether the point is seen at a step of a motion, and not too obliquely (up to 78 degrees between
    /// line of sight and normal).
    bool is_visible(const SurfacePoint& point, int motion, int step) const noexcept;

    /// What is seen at a place of the image.
    std::optional<SurfacePoint> surface_at(glm::dvec2 image_point_px, const ObjectPose& angle) const noexcept;

    /// Image place of a point of the object, whose turn is `world_from_object`.
    glm::dvec2 project(glm::dvec3 object_point, const glm::dmat4& world_from_object) const noexcept;
    /// How much farther to the right the other eye has it, where the two have pictures of their own.
    double other_eye_right_px(glm::dvec3 object_point, const glm::dmat4& world_from_object) const noexcept;
    glm::dmat4 world_from_object(const ObjectPose& angle) const noexcept;

  private:
    struct WeightedTriangles {
        std::vector<std::uint32_t> triangles;
        std::vector<double> cumulative; ///< weighted area up to and with each triangle

        void add(std::uint32_t triangle, double weight) {
            triangles.push_back(triangle);
            cumulative.push_back((cumulative.empty() ? 0.0 : cumulative.back()) + weight);
        }
    };

    /// A region with triangles: this one, else elsewhere, else the first that has any.
    const WeightedTriangles& region_or_other(std::size_t region) const noexcept;
    SurfacePoint draw_from(RandomStream& random, const WeightedTriangles& from) const noexcept;
    struct Spot {
        SurfacePoint middle;
        double radius = 0.0;
        WeightedTriangles triangles; ///< that may reach into it
    };
    Spot spot_about(const SurfacePoint& middle) const;
    void find_middle();

    const Mesh* mesh_;
    SceneView scene_;
    RayCaster caster_;
    /// The camera as the object sees it, by motion and by step of a period.
    std::vector<std::vector<glm::dvec3>> eyes_;
    std::vector<WeightedTriangles> regions_; ///< the last is elsewhere
    std::vector<Spot> spots_;                ///< by effect
    glm::dvec3 middle_{0.0};                 ///< of all regions by weighted area
    double usual_square_ = 1.0;              ///< mean square distance from it
    double most_square_ = 1.0;               ///< largest, as a multiple of that
};

} // namespace overt
