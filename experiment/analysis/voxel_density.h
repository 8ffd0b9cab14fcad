/// Density of points in space on a grid of voxels, blurred by a Gaussian: the paper's way from gaze on the
/// surface to a map (Sidorov et al. 2019, section 3).
#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "experiment/scene/mesh.h"

namespace overt {

class VoxelDensity {
  public:
    /// Covers `bounds` and three sigmas around it with cubes of sigma / 2. `sigma` > 0, in the mesh's unit.
    VoxelDensity(const Bounds& bounds, double sigma);

    void add(glm::dvec3 point, double weight = 1.0);

    /// Convolves with the Gaussian, once, after all points were added.
    void blur();

    /// Weight per cube of the mesh's unit at a place, between voxels linearly; 0 outside the grid.
    double at(glm::dvec3 point) const;

  private:
    std::size_t index_of(glm::ivec3 cell) const;
    glm::dvec3 origin_;
    double cell_;
    double sigma_;
    glm::ivec3 cells_;
    std::vector<double> values_;
};

} // namespace overt
