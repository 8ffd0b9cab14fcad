/// Ways along an object's surface between the places of fixations.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "experiment/study/read/study_reader.h"
#include "experiment/surface/coarse_surface.h"

namespace overt {

/// Of all counted fixations on one object. Distances are those between the nearest vertices of a surface of
/// 4,000 nodes (GeodesicField), times how much farther apart the places themselves are in space than these;
/// where they are next to each other, those in space.
class SurfaceDistances {
  public:
    /// `surface` must have a geometry and a scale; `results` must keep its fixations where they are. All
    /// processors reckon.
    SurfaceDistances(const StudyResults& results, int object, const ObjectSurface& surface);

    /// mm; infinite: there is no way.
    double between(const StudyFixation& a, const StudyFixation& b) const;
    /// The largest of these between any two that have a way; 0: there are none.
    double extent_mm() const { return extent_mm_; }
    /// Share of the visible surface that is no farther than this from any of the fixations, along it. Nothing
    /// of it where nothing is visible.
    double covered(std::span<const StudyFixation* const> fixations, double reach_mm) const;

  private:
    struct Place {
        std::size_t source = 0; ///< index of its vertex among those with distances
        glm::dvec3 position_mm{0.0};
    };
    float to_vertex(std::size_t source, std::uint32_t vertex) const {
        return distances_[source * coarse_.vertex_count() + vertex];
    }

    CoarseSurface coarse_;
    std::map<const StudyFixation*, Place> places_;
    std::vector<std::uint32_t> sources_;   ///< vertices of the coarse surface
    std::vector<glm::dvec3> positions_mm_; ///< of the sources
    std::vector<float> distances_;         ///< by source and vertex
    std::vector<double> visible_mm2_;      ///< by vertex
    double spacing_mm_ = 0.0, extent_mm_ = 0.0;
};

} // namespace overt
