/// Places of a surface that stand for all of it in integrals over smooth maps.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "experiment/surface/surface_hats.h"

namespace overt {

/// Nodes of a surface that lie as far apart everywhere, whatever its shape: flat faces have as many to an
/// area as curved ones. Simplified meshes do not, and metrics over them weigh a flat face by the few nodes
/// that it keeps.
///
/// The nodes are the centres of hats, no more than their spacing from any place, or all nodes there are. The
/// area for which one stands is the integral of its hat: hats add up to 1, so that the areas add up to the
/// surface's.
class SurfaceSamples {
  public:
    static constexpr auto none = std::numeric_limits<std::uint32_t>::max();

    /// Every node of the surface. `geometry` must live as long as this.
    explicit SurfaceSamples(const SurfaceGeometry& geometry);
    /// The centres of hats on it.
    SurfaceSamples(const SurfaceGeometry& geometry, const SurfaceHats& hats);

    std::size_t count() const { return nodes_.size(); }
    /// The surface's node that a sample is.
    std::span<const std::uint32_t> nodes() const { return nodes_; }
    /// The sample that is nearest to a node along the surface; none for a node of no triangle.
    std::uint32_t nearest(std::uint32_t node) const { return nearest_[node]; }

    /// By sample, mm^2: of what counts of the surface, by node. All of it where `counts` is empty.
    std::vector<double> areas_mm2(std::span<const char> counts = {}) const;

    /// Samples whose nearest nodes share an edge: those of sample i, rising, are
    /// neighbours()[neighbours_begin()[i]] up to neighbours_begin()[i + 1].
    std::span<const std::uint32_t> neighbours_begin() const { return neighbours_begin_; }
    std::span<const std::uint32_t> neighbours() const { return neighbours_; }

  private:
    void find_neighbours();

    const SurfaceGeometry& geometry_;
    const SurfaceHats* hats_ = nullptr;
    std::vector<std::uint32_t> nodes_, nearest_;
    std::vector<std::uint32_t> neighbours_begin_, neighbours_;
};

} // namespace overt
