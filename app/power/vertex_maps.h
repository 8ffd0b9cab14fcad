/// Maps of fixations as sums of maps that are made once.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "experiment/statistics/cluster_test.h"
#include "experiment/study/read/study_reader.h"
#include "experiment/surface/coarse_surface.h"
#include "experiment/surface/surface_geometry.h"

namespace overt {

/// The map of one fixation at each vertex of a coarse surface. Heat adds up, so every map is a weighted sum
/// of these. Unlike the analysis, which has each fixation's own kernel and leaves out what no frame shows,
/// the kernel has one width everywhere, that in the depth of the object's axis, and all of the surface
/// counts.
class VertexMaps {
  public:
    /// `most_threads` as in SurfaceSmoother::densities.
    VertexMaps(const Mesh& mesh, const ObjectScale& scale, const KernelWidth& sigma, int most_threads);

    std::span<const double> areas() const { return areas_; }
    /// By vertex; fixations count alike.
    std::vector<double> sum_of(std::span<const StudyFixation* const> fixations) const;
    /// The share of their time, per mm^2. At least one fixation.
    std::vector<double> share_of_time(std::span<const StudyFixation* const> fixations) const;
    /// Vertices beside each other.
    Adjacency adjacency() const { return {neighbours_begin_, neighbours_}; }

  private:
    template <class Weight>
    std::vector<double> weighted_sum(std::span<const StudyFixation* const> fixations,
                                     const Weight& weight_of_one) const;
    void find_neighbours();

    SurfaceGeometry fine_;
    CoarseSurface coarse_;
    std::vector<double> areas_;
    std::vector<std::vector<float>> maps_; ///< by vertex
    std::vector<std::uint32_t> neighbours_begin_, neighbours_;
};

} // namespace overt
