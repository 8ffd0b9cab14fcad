/// From the surface of one object to that of another, and back.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "experiment/scene/nearest_sites.h"
#include "experiment/study/results/study_results.h"
#include "experiment/surface/landmark_warp.h"

namespace overt {

/// Places of an object are warped, and then laid onto the nearest place of the template that belongs to the
/// same areas: of the areas that both have by name, a place keeps those in which it is. Where the template
/// has no such place, the nearest of all is taken. May be asked from any number of threads at once.
class SurfaceBridge {
  public:
    /// Both have a mesh and mm_per_unit, and must outlive this.
    SurfaceBridge(const StudyObject& object, const StudyObject& onto, LandmarkWarp warp);

    struct Laid {
        SurfaceSite site;     ///< on the template
        double away_mm = 0.0; ///< of the warped place from it
    };
    /// `part`: of the object, whose areas the place keeps; nothing: that of the place's triangle.
    Laid onto_template(const SurfaceSite& place, std::optional<PartIndex> part = {}) const;

    /// The place of the object that, warped, is nearest to a place of the template, by the same rule.
    SurfaceSite from_template(const SurfaceSite& place) const;

    /// Direction of the object's outward side at a triangle after the warp; not of unit length.
    glm::dvec3 warped_normal(std::uint32_t triangle) const;
    const LandmarkWarp& warp() const { return warp_; }

  private:
    /// Nearest places by the areas that both have, of a mesh.
    struct Side {
        const Mesh* mesh = nullptr;
        std::vector<std::string> areas_of_part; ///< those that both have, by PartIndex
        std::map<std::string, NearestSites> of_areas;
        std::optional<NearestSites> of_all; ///< where the other side has areas together that this one has not
    };
    Side side(const StudyObject& of, const StudyObject& other, const Mesh& mesh) const;
    static const NearestSites& sites(const Side& side, const std::string& areas);

    const StudyObject& object_;
    const StudyObject& onto_;
    LandmarkWarp warp_;
    Mesh warped_; ///< the object's, in the template's unit
    Side template_side_, object_side_;
};

} // namespace overt
