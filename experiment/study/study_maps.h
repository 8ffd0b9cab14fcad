/// Fixations of groups as maps on objects.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "experiment/study/read/study_reader.h"
#include "experiment/study/results/study_groups.h"
#include "experiment/study/results/study_options.h"
#include "experiment/surface/surface_smoother.h"

namespace overt {

/// Makes densities on one object's mesh with the kernel that the options name.
class DensityMaker {
  public:
    /// `surface` must have a geometry and a scale, and outlive this, as `mesh` must; its hats are used if it
    /// has them. `widest_sigma_mm` > 0.
    DensityMaker(const ObjectSurface& surface, const Mesh& mesh, const StudyOptions& options,
                 double widest_sigma_mm);

    /// Density by vertex in weight per mm^2 for each of the maps. Sigmas: those of counted fixations.
    std::vector<std::vector<double>> densities(std::span<const std::vector<SurfaceWeight>> maps) const;

  private:
    std::vector<double> in_voxels(std::span<const SurfaceWeight> weights) const;

    const ObjectSurface& surface_;
    const Mesh& mesh_;
    MapKernel kernel_;
    std::unique_ptr<SurfaceSmoother> smoother_;
};

/// A fixation's weight on the surface; it must have met a mesh.
SurfaceWeight weight_of(const StudyFixation& fixation, double weight);

/// The objects that a group's trials showed, rising.
std::vector<int> objects_of(const StudyResults& results, const StudyGroup& group);

/// The counted fixations of some trials on one object.
std::vector<const StudyFixation*> fixations_on(const StudyResults& results, std::span<const int> trials,
                                               int object);

/// The narrowest and the widest kernel of the counted fixations on an object; 0 and 0 without any.
std::pair<double, double> sigma_range_mm(const StudyResults& results, int object);

/// The exposure's density by vertex of one object; empty without one.
std::vector<float> exposure_density(const StudyResults& results, int of, const ObjectSurface& surface,
                                    const DensityMaker& maker, const StudyOptions& options);

/// The maps of all groups on one object, by duration and by count. May be called from any thread.
std::vector<StudyMap> maps_on(const StudyResults& results, int object, const ObjectSurface& surface,
                              const DensityMaker* maker);

} // namespace overt
