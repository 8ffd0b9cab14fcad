/// Density of points in space on a grid of voxels, blurred by a Gaussian: the paper's way from gaze on the
/// surface to a map (Sidorov et al. 2019, section 3.1).
#pragma once

#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "experiment/scene/mesh.h"

namespace overt {

/// The Gaussian in space does not know the surface: it goes over gaps, and much of it lies in the air, so
/// densities are per volume. SurfaceSmoother is for what lies on the surface.
class VoxelDensity {
  public:
    /// Where the kernel is cut off, in sigmas, unless said otherwise; scipy.ndimage.gaussian_filter's, too.
    static constexpr double usual_truncation = 4.0;
    /// A gigabyte of numbers.
    static constexpr double most_cells = 134217728.0;

    /// Covers `bounds` and what of the kernel goes beyond with cubes of sigma / 2. `sigma` > 0, in the unit
    /// of the bounds. Throws InputError if these would be more than most_cells.
    VoxelDensity(const Bounds& bounds, double sigma);
    /// With that many cubes along the longest side of the box and its margin (8 … 1024), however wide they
    /// are.
    VoxelDensity(const Bounds& bounds, double sigma, int cells, double truncation = usual_truncation);

    /// The weight of a point goes to the voxel whose centre is nearest. Points outside of the grid are lost.
    void add(glm::dvec3 point, double weight = 1.0);

    /// Convolves with the Gaussian, once, after all points were added: three passes along the axes, each with
    /// the kernel at whole voxels, normalised to 1. On all processors; the result does not depend on how
    /// many.
    void blur(int most_threads = 0);

    /// Weight per cube of the unit at a place, between voxels linearly; 0 outside the grid.
    double at(glm::dvec3 point) const;

    glm::ivec3 cells() const { return cells_; }
    double cell_side() const { return cell_; }
    /// Centre of the first voxel.
    glm::dvec3 origin() const { return origin_; }
    double sigma() const { return sigma_; }
    /// Weight per cube of the unit; x runs fastest.
    std::span<const double> values() const { return values_; }

  private:
    VoxelDensity(const Bounds& bounds, double sigma, double cell, glm::ivec3 cells, double truncation);
    std::size_t index_of(glm::ivec3 cell) const;
    void blur_along_x(std::span<const double> kernel, int most_threads);
    void blur_across_rows(std::span<const double> kernel, int axis, int most_threads);

    glm::dvec3 origin_;
    double cell_;
    double sigma_;
    double truncation_;
    glm::ivec3 cells_;
    std::vector<double> values_;
};

} // namespace overt
