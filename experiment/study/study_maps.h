/// Fixations of groups as maps on sculptures.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "experiment/study/study_groups.h"
#include "experiment/study/study_options.h"
#include "experiment/study/study_reader.h"
#include "experiment/surface/surface_smoother.h"

namespace overt {

/// Makes densities on one sculpture's mesh with the kernel that the options name.
class MapMaker {
  public:
    /// `surface` must have a geometry and a scale, and outlive this, as `mesh` must. `widest_sigma_mm` > 0.
    MapMaker(const SculptureSurface& surface, const Mesh& mesh, const StudyOptions& options,
             double widest_sigma_mm);

    /// Density by vertex in weight per mm^2 for each of the maps. Sigmas: up to the widest.
    std::vector<std::vector<double>> densities(std::span<const std::vector<SurfaceWeight>> maps) const;

  private:
    std::vector<double> in_voxels(std::span<const SurfaceWeight> weights) const;

    const SculptureSurface& surface_;
    const Mesh& mesh_;
    MapKernel kernel_;
    std::unique_ptr<SurfaceSmoother> smoother_;
};

/// A fixation's weight on the surface; it must have met a mesh.
SurfaceWeight weight_of(const StudyFixation& fixation, double weight);

/// The sculptures that a group's trials showed, rising.
std::vector<int> sculptures_of(const StudyResults& results, const StudyGroup& group);

/// The counted fixations of some trials on one sculpture.
std::vector<const StudyFixation*> fixations_on(const StudyResults& results, std::span<const int> trials,
                                               int sculpture);

/// The widest kernel of the counted fixations on a sculpture; 0 without any.
double widest_sigma_mm(const StudyResults& results, int sculpture);

/// Adds the maps of all groups on one sculpture, by duration and by count, and its exposure.
void add_maps(StudyResults& results, int sculpture, const SculptureSurface& surface, const MapMaker* maker,
              const StudyOptions& options);

} // namespace overt
