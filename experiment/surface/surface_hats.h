/// Smooth functions on a surface that need far fewer numbers than its nodes: sums of overlapping hats.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "experiment/surface/surface_geometry.h"

namespace overt {

/// Centres lie at least a spacing apart along the surface, and no node is farther than a spacing from one. A
/// hat falls with the distance d along the surface as 1 - 3 r^2 + 2 r^3, r = d / (2 spacing), to 0 at twice
/// the spacing, and hats are divided by their sum, so that they add up to 1 everywhere (Nasikun, Brandt and
/// Hildebrandt, "Fast approximation of Laplace-Beltrami eigenproblems", Computer Graphics Forum 37, 2018).
/// They go around edges and along sheets as distances do, and from one piece of the surface to none other.
class SurfaceHats {
  public:
    /// `geometry` must live as long as this. `spacing_mm` > 0. The same geometry gives the same hats.
    SurfaceHats(const SurfaceGeometry& geometry, double spacing_mm);

    std::size_t count() const { return centres_.size(); }
    /// The node at which a hat has its centre.
    std::uint32_t centre(std::uint32_t hat) const { return centres_[hat]; }

    /// A hat's value at a node, > 0.
    struct Share {
        std::uint32_t hat;
        double value;
    };
    /// All at a node; their sum is 1. None at a node of no triangle.
    std::span<const Share> at(std::uint32_t node) const {
        return std::span(shares_).subspan(begin_[node], begin_[node + 1] - begin_[node]);
    }

    /// About how many hats a surface has at a spacing.
    static double expected_count(const SurfaceGeometry& geometry, double spacing_mm) {
        // Points dropped at random until no more fit: the coverage 0.547 of equal discs (Renyi's constant in
        // the plane; Feder, Journal of Theoretical Biology 87, 1980).
        return 0.70 * geometry.total_area_mm2() / (spacing_mm * spacing_mm);
    }

  private:
    std::vector<std::uint32_t> centres_;
    std::vector<std::size_t> begin_; ///< by node, one more at the end
    std::vector<Share> shares_;
};

} // namespace overt
