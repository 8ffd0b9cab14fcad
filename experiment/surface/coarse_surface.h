/// A surface with fewer nodes, for what needs no more: statistics over many maps, and pictures.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "experiment/surface/surface_geometry.h"

namespace overt {

/// The nodes are some of those of the fine surface, chosen so that its shape changes least (quadric error
/// metrics, Garland and Heckbert 1997, by meshoptimizer). On a shipped sculpture of 142,000 vertices, as
/// large as it is shown, and sigmas of 1 degree, 30,000 nodes move 0.6 % of a map's mass (correlation 0.999)
/// and 15,000 nodes 1.5 % (0.995), in an eighth and a fourteenth of the time (measured once).
class CoarseSurface {
  public:
    /// `fine` must live as long as this. At most about `most_nodes`; all of them if there are no more. Which
    /// are kept hangs on rounding where several are as good: they are chosen at `size` times the surface's
    /// size, so that surfaces of one shape, chosen at one size, keep the same ones in whatever unit they are.
    CoarseSurface(const SurfaceGeometry& fine, std::size_t most_nodes, double size = 1.0);

    /// In millimetres. The parts are left out.
    const Mesh& mesh() const { return mesh_; }
    std::size_t vertex_count() const { return node_of_vertex_.size(); }
    /// The node of the fine surface that a vertex is.
    std::uint32_t fine_node_of(std::uint32_t vertex) const { return node_of_vertex_[vertex]; }
    /// The vertex that is nearest to a node of the fine surface, along its edges.
    std::uint32_t vertex_near(std::uint32_t fine_node) const { return vertex_near_[fine_node]; }

    /// A weight on the fine surface as weights on this one: at the vertices nearest to the corners of its
    /// triangle. Their sum is the weight.
    std::array<SurfaceWeight, 3> moved(const SurfaceWeight& weight) const;

    /// A vertex as a place of this surface.
    const SurfacePlace& place_of(std::uint32_t vertex) const { return places_[vertex]; }

  private:
    void find_nearest();

    const SurfaceGeometry& fine_;
    Mesh mesh_;
    std::vector<std::uint32_t> node_of_vertex_;
    std::vector<std::uint32_t> vertex_near_; ///< by fine node
    std::vector<SurfacePlace> places_;       ///< of the vertices, each in one of its triangles
};

} // namespace overt
