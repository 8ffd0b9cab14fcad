/// Each fixation's own density on the surface: maps of any choice of fixations are sums.
#pragma once

#include <map>
#include <memory>
#include <span>
#include <vector>

#include "experiment/statistics/cluster_test.h"
#include "experiment/study/read/study_reader.h"
#include "experiment/study/results/study_options.h"
#include "experiment/surface/surface_samples.h"
#include "experiment/surface/surface_smoother.h"

namespace overt {

using Fixations = std::vector<const StudyFixation*>;

/// Of the counted fixations on one object, blurred along the surface with their own sigmas. Maps are given
/// by sample of the object's surface, per mm^2: samples are at most the least sigma / 3 apart everywhere,
/// or are all nodes of the mesh. Metrics over them differ from those over all nodes by less than 0.01 in CC
/// and 0.01 bits (tests/experiment/study/fixation_maps_test.cpp).
class FixationMaps {
  public:
    /// `surface` must have a geometry and a scale, and fixations on the object have been counted. `results`
    /// must outlive this and keep its fixations where they are, as must `surface`.
    FixationMaps(const StudyResults& results, int object, const ObjectSurface& surface);

    /// By sample, mm^2.
    std::span<const double> areas() const { return areas_; }
    /// The same, of what some frame shows.
    std::span<const double> visible_areas() const { return visible_areas_; }
    /// The exposure's density, whose integral over the visible areas is 1; empty if nothing was ever visible.
    std::span<const double> exposure() const { return exposure_; }
    /// The part that a sample belongs to.
    PartIndex part(std::uint32_t sample) const { return parts_[sample]; }
    glm::dvec3 position_mm(std::uint32_t sample) const;
    const SurfaceSamples& samples() const { return *samples_; }
    const SurfaceGeometry& geometry() const { return *surface_.geometry; }
    /// Samples beside each other.
    Adjacency adjacency() const { return {samples_->neighbours_begin(), samples_->neighbours()}; }

    std::vector<double> sum_of(std::span<const StudyFixation* const> fixations) const;
    /// Each as much as it lasted, in seconds.
    std::vector<double> durations_of(std::span<const StudyFixation* const> fixations) const;

    /// What the sum of some fixations' maps has at the places of others.
    std::vector<double> sum_at(std::span<const StudyFixation* const> fixations,
                               std::span<const StudyFixation* const> places) const;
    /// Numbers of the surface's nodes: by sample, and at the places of fixations.
    std::vector<double> at_samples(std::span<const double> by_node) const;
    std::vector<double> at_places(std::span<const double> by_node,
                                  std::span<const StudyFixation* const> places) const;
    /// What the exposure has there.
    std::vector<double> exposure_at(std::span<const StudyFixation* const> places) const;

    /// Sums of fixations' maps, each times its weight, by vertex of the mesh; any number of sums at once.
    std::vector<std::vector<double>> at_vertices(std::span<const std::vector<SurfaceWeight>> weights) const;

  private:
    /// A number of a map that is nowhere else: where it is, and how much.
    struct Entry {
        std::uint32_t index;
        float value;
    };
    /// A fixation's density: at samples, and at places of other fixations.
    struct Own {
        std::vector<Entry> at_samples, at_fixations;
    };

    void make_samples(double least_sigma_mm);
    void make_maps(std::span<const StudyFixation* const> fixations);
    void find_visible(const StudyObject& object, std::span<const StudyFixation* const> fixations);
    void add_to(std::vector<double>& sum, const StudyFixation& fixation, double weight) const;

    const ObjectSurface& surface_;
    std::unique_ptr<SurfaceSmoother> smoother_; ///< null where the surface has hats
    std::unique_ptr<SurfaceHats> sparser_;      ///< only to choose samples among too many nodes
    std::unique_ptr<SurfaceSamples> samples_;
    std::vector<double> areas_, visible_areas_, exposure_, exposure_at_; ///< the last by fixation
    std::vector<PartIndex> parts_;
    std::map<const StudyFixation*, std::uint32_t> index_of_;
    std::vector<Own> maps_;
};

/// By object; null where there can be none.
using ObjectFixationMaps = std::vector<std::unique_ptr<FixationMaps>>;
ObjectFixationMaps fixation_maps(const StudyResults& results, const std::vector<ObjectSurface>& surfaces);

/// The columns of `--by` besides the compared one and the object.
std::vector<std::string> columns_beside_compared(const StudyOptions& options);

} // namespace overt
