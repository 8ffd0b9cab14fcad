/// Maps of fixations as sums of maps that are made once.
#pragma once

#include <span>
#include <vector>

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

  private:
    SurfaceGeometry fine_;
    CoarseSurface coarse_;
    std::vector<double> areas_;
    std::vector<std::vector<float>> maps_; ///< by vertex
};

} // namespace overt
