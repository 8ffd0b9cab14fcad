/// Each fixation's own density on a coarse surface: maps of any choice of fixations are sums.
#pragma once

#include <map>
#include <memory>
#include <span>
#include <vector>

#include "experiment/statistics/cluster_test.h"
#include "experiment/study/read/study_reader.h"
#include "experiment/study/results/study_options.h"

namespace overt {

using Fixations = std::vector<const StudyFixation*>;

/// Of the counted fixations on one object, blurred along the surface with their own sigmas. Maps are given
/// by vertex of the object's coarse surface, per mm^2.
class FixationMaps {
  public:
    /// `surface` must have a coarse geometry, and fixations on the object have been counted. `results`
    /// must outlive this and keep its fixations where they are, as must `surface`.
    FixationMaps(const StudyResults& results, int object, const ObjectSurface& surface);

    /// By vertex, mm^2.
    std::span<const double> areas() const { return areas_; }
    /// The same, with 0 for what no frame shows.
    std::span<const double> visible_areas() const { return visible_areas_; }
    /// The exposure's density, whose integral over the visible areas is 1; empty if nothing was ever visible.
    std::span<const double> exposure() const { return exposure_; }
    /// The part that a vertex belongs to.
    PartIndex part(std::uint32_t vertex) const { return parts_[vertex]; }
    const CoarseSurface& surface() const { return *surface_.coarse; }
    const SurfaceGeometry& fine() const { return *surface_.geometry; }
    /// Vertices that share an edge.
    Adjacency adjacency() const { return {neighbours_begin_, neighbours_}; }

    std::vector<double> sum_of(std::span<const StudyFixation* const> fixations) const;
    /// Each as much as it lasted, in seconds.
    std::vector<double> durations_of(std::span<const StudyFixation* const> fixations) const;

    /// What a map has at the place of a fixation, between the vertices as they count there.
    double at(std::span<const double> map, const StudyFixation& fixation) const;

  private:
    struct Place {
        std::uint32_t vertex;
        double share;
    };
    void add_to(std::vector<double>& sum, const StudyFixation& fixation, double weight) const;
    void find_visible(const StudyObject& object);
    void find_neighbours();

    const ObjectSurface& surface_;
    std::vector<double> areas_, visible_areas_, exposure_;
    std::vector<PartIndex> parts_;
    std::vector<std::uint32_t> neighbours_begin_, neighbours_;
    std::map<const StudyFixation*, std::size_t> index_of_;
    std::vector<std::vector<float>> maps_;
    std::vector<std::vector<Place>> places_;
};

/// By object; null where there can be none.
using ObjectFixationMaps = std::vector<std::unique_ptr<FixationMaps>>;
ObjectFixationMaps fixation_maps(const StudyResults& results, const std::vector<ObjectSurface>& surfaces);

/// The columns of `--by` besides the compared one and the object.
std::vector<std::string> columns_beside_compared(const StudyOptions& options);

} // namespace overt
