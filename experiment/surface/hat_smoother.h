/// Weights spread along a large surface in a fraction of the time: in a space of smooth functions.
#pragma once

#include <span>
#include <vector>

#include "experiment/surface/heat_times.h"
#include "experiment/surface/sparse_factor.h"
#include "experiment/surface/surface_hats.h"

namespace overt {

/// What SurfaceSmoother makes, up to what hats a fraction of a sigma apart cannot hold: heat flows in their
/// space (Galerkin's method), with areas and cotangent weights of all the surface's nodes. The mass of each
/// piece of the surface is kept. Correlation with SurfaceSmoother's map is above 0.995 (measured on shipped
/// objects and in tests/experiment/surface). That hats are stiffer than the surface is taken into account.
class HatSmoother {
  public:
    /// Hats are the least sigma divided by this apart.
    static constexpr double hats_per_sigma = 3.0;

    /// Whether this takes much less work than all of the surface's nodes.
    static bool is_worth_while(const SurfaceGeometry& geometry, double least_sigma_mm);

    /// `geometry` must live as long as this. 0 < least_sigma_mm <= widest_sigma_mm, at most 6 times as wide.
    HatSmoother(const SurfaceGeometry& geometry, double least_sigma_mm, double widest_sigma_mm);

    /// Those in whose space heat flows.
    const SurfaceHats& hats() const { return hats_; }

    /// Density by vertex of the mesh for each of the maps, in weight per mm^2. Sigmas from the least to the
    /// widest. The same bits on any number of threads; `most_threads` 0: all processors.
    std::vector<std::vector<double>> densities(std::span<const std::vector<SurfaceWeight>> maps,
                                               int most_threads = 0) const;

    /// The same at some nodes only, for statistics of many maps. `areas_mm2`: for what area each node stands;
    /// the sum of densities times these is that of the weights.
    std::vector<std::vector<double>> densities_at(std::span<const std::vector<SurfaceWeight>> maps,
                                                  std::span<const std::uint32_t> nodes,
                                                  std::span<const double> areas_mm2,
                                                  int most_threads = 0) const;

  private:
    /// Calls take(first of the maps, densities by hat of all that are made together) on many threads.
    template <class Take>
    void make(std::span<const std::vector<SurfaceWeight>> maps, int most_threads, const Take& take) const;
    template <class NodeAt>
    void take_values(std::span<const double> of_hats, std::span<const double> areas_mm2,
                     const NodeAt& node_at, std::span<const std::vector<SurfaceWeight>> maps,
                     std::span<std::vector<double>> results) const;
    std::vector<double> hats_together(std::span<const std::vector<SurfaceWeight>> maps) const;
    void multiply(std::vector<double>& densities) const;

    const SurfaceGeometry& geometry_;
    double least_sigma_mm_, widest_sigma_mm_;
    HeatTimes times_;
    SurfaceHats hats_;
    /// Integrals of products of two hats, all of each row.
    std::vector<std::size_t> products_begin_;
    std::vector<SurfaceHats::Share> products_;
    SparseFactor factor_;
};

} // namespace overt
