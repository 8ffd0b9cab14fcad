/// Weights at places of a surface, spread along it: the default saliency maps are made this way.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "experiment/surface/heat_times.h"
#include "experiment/surface/sparse_factor.h"
#include "experiment/surface/surface_geometry.h"

namespace overt {

/// The Gaussian of a surface is heat that has flowed on it for the time sigma^2 / 2: on a plane that is the
/// Gaussian with sigma along each axis, on a sphere the heat kernel, and it never leaps over a gap to another
/// sheet of surface, as a Gaussian in space does (EuclideanKernel says how much). At the rim of a hole
/// nothing flows out.
///
/// Linear elements with intrinsic Delaunay weights, areas lumped at the nodes, and the steps of HeatTimes
/// with one factorisation. Within rounding, each piece of the surface keeps the mass it was given, and no
/// density is negative. On a flat regular mesh with six edges to a sigma, the density differs from the
/// Gaussian by at most 1.8 % of its peak, and 0.55 % of the mass is elsewhere; with four edges 3 % and 0.9 %
/// (measured, tests/experiment/surface). With sigmas below two edges it is the mesh that decides.
class SurfaceSmoother {
  public:
    /// `geometry` must live as long as the smoother. Sigmas down to 0.62 of the widest come out as said
    /// above; narrower ones have a peak that is too high by the relative variance that HeatTimes tells.
    SurfaceSmoother(const SurfaceGeometry& geometry, double widest_sigma_mm);

    double widest_sigma_mm() const { return widest_sigma_mm_; }

    /// Density by vertex of the mesh, in weight per mm^2: the sum over vertices of density times area is the
    /// sum of the weights. Sigmas: at most the widest, at least a sixth of it.
    std::vector<double> density(std::span<const SurfaceWeight> weights) const;

    /// The same of many maps at once, eight times as fast, on `most_threads` threads (0: all processors).
    /// Each map is the same to the bit, whichever are made with it and on however many threads.
    std::vector<std::vector<double>> densities(std::span<const std::vector<SurfaceWeight>> maps,
                                               int most_threads = 0) const;

  private:
    std::vector<std::vector<double>>
    densities_together(std::span<const std::vector<SurfaceWeight>> maps) const;

    const SurfaceGeometry& geometry_;
    double widest_sigma_mm_;
    HeatTimes times_;
    SparseFactor factor_;
};

} // namespace overt
