/// Ways along an object's surface, on a coarser one that is made when it is first needed.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "experiment/maps/surface_point.h"
#include "experiment/scene/object_scale.h"
#include "experiment/surface/coarse_surface.h"
#include "experiment/surface/geodesic_field.h"

namespace overt {

/// Of the surface for statistics over many maps, and for ways: a quarter of a usual kernel between
/// neighbours.
inline constexpr std::size_t coarse_nodes = 4000;

/// Not for use from several threads at once; make one for each.
class SurfaceWays {
  public:
    /// On surfaces that are there; all of them must outlive this. `coarse_geometry` is that of `coarse`.
    SurfaceWays(const SurfaceGeometry& fine, const CoarseSurface& coarse,
                const SurfaceGeometry& coarse_geometry);
    /// On surfaces of its own, made of the mesh, which must outlive this.
    SurfaceWays(const Mesh& mesh, const ObjectScale& scale);
    SurfaceWays(const SurfaceWays&) = delete;
    SurfaceWays& operator=(const SurfaceWays&) = delete;

    /// The places that are at one vertex of the coarse surface, from which the sum of the ways to all of
    /// `places` (one at least) is least: their indices, rising.
    std::vector<std::size_t> nearest_to_all(std::span<const SurfacePoint* const> places);

  private:
    void make();
    /// The vertex of the coarse surface that is nearest to a corner of a triangle of the mesh.
    std::uint32_t vertex_near(std::uint32_t triangle, int corner) const;
    const SurfacePlace& place_of(std::uint32_t vertex) const;

    // Another's surfaces; null if they are its own.
    const SurfaceGeometry* fine_ = nullptr;
    const CoarseSurface* coarse_ = nullptr;
    // Its own: of the fine one, which is large, only what is asked for is kept.
    const Mesh* mesh_ = nullptr;
    ObjectScale scale_;
    std::vector<std::uint32_t> vertex_near_; ///< by vertex of the mesh
    std::vector<SurfacePlace> places_;       ///< by vertex of the coarse surface
    std::optional<SurfaceGeometry> coarse_geometry_;
    std::optional<GeodesicField> field_;
};

} // namespace overt
