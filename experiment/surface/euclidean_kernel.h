/// The Gaussian in space on the vertices of a mesh, as most published maps have it, and what of it leaks.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "experiment/surface/surface_geometry.h"

namespace overt {

/// Each weight is spread over the nodes within four sigmas by exp(-d^2 / (2 sigma^2)) times their area, with
/// d the straight distance, whether or not the surface leads there. Where none is so near, it goes to the
/// corners of its triangle.
class EuclideanKernel {
  public:
    /// The share beyond three sigmas that is no leak: exp(-9 / 2).
    static constexpr double share_on_a_plane = 0.0111089965;

    /// `geometry` must live as long as the kernel. May be used from any thread.
    explicit EuclideanKernel(const SurfaceGeometry& geometry);

    /// By vertex of the mesh, weight per mm^2. Sigmas above 0.
    std::vector<double> density(std::span<const SurfaceWeight> weights) const;

    /// The share of a weight at one place, with each of these sigmas, above 0, that comes to lie farther than
    /// three sigmas along the surface: leaks over gaps. Distances along the surface, which take nearly all
    /// the time, are found once.
    std::vector<double> leaked_shares(const SurfacePlace& place, std::span<const double> sigmas_mm) const;

  private:
    /// The nodes about a place with the Gaussian's values there; gives its integral over their areas.
    double spread(const glm::dvec3& place, double sigma_mm,
                  std::vector<std::pair<std::uint32_t, double>>& nodes) const;
    template <class Visit>
    void for_each_near(const glm::dvec3& place, double radius, const Visit& visit) const;

    const SurfaceGeometry& geometry_;
    glm::dvec3 origin_{0.0};
    double cell_mm_ = 1.0;
    glm::ivec3 cells_{1};
    std::vector<std::size_t> begin_; ///< by cell, one more at the end
    std::vector<std::uint32_t> nodes_;
};

} // namespace overt
