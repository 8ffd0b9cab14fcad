#include "experiment/study/fixations/surface_ways.h"

#include <map>

namespace overt {

SurfaceWays::SurfaceWays(const SurfaceGeometry& fine, const CoarseSurface& coarse,
                         const SurfaceGeometry& coarse_geometry)
    : fine_(&fine), coarse_(&coarse) {
    field_.emplace(coarse_geometry);
}

SurfaceWays::SurfaceWays(const Mesh& mesh, const ObjectScale& scale) : mesh_(&mesh), scale_(scale) {}

void SurfaceWays::make() {
    const SurfaceGeometry fine(*mesh_, scale_.mm_per_unit);
    const CoarseSurface coarse(fine, coarse_nodes, scale_.shown_size);
    vertex_near_.resize(fine.vertex_count());
    for (std::uint32_t vertex = 0; vertex < vertex_near_.size(); ++vertex)
        vertex_near_[vertex] = coarse.vertex_near(fine.node_of(vertex));
    places_.reserve(coarse.vertex_count());
    for (std::uint32_t vertex = 0; vertex < coarse.vertex_count(); ++vertex)
        places_.push_back(coarse.place_of(vertex));
    field_.emplace(coarse_geometry_.emplace(coarse.mesh()));
}

std::uint32_t SurfaceWays::vertex_near(std::uint32_t triangle, int corner) const {
    return mesh_ ? vertex_near_[mesh_->triangles[triangle][corner]]
                 : coarse_->vertex_near(fine_->corners(triangle)[corner]);
}

const SurfacePlace& SurfaceWays::place_of(std::uint32_t vertex) const {
    return mesh_ ? places_[vertex] : coarse_->place_of(vertex);
}

std::vector<std::size_t> SurfaceWays::nearest_to_all(std::span<const SurfacePoint* const> places) {
    if (!field_)
        make();
    std::map<std::uint32_t, std::vector<std::size_t>> at_vertex;
    for (std::size_t i = 0; i < places.size(); ++i) {
        const SurfacePoint& point = *places[i];
        int corner = 0;
        for (int other = 1; other < 3; ++other)
            corner = point.barycentric[other] > point.barycentric[corner] ? other : corner;
        at_vertex[vertex_near(point.triangle, corner)].push_back(i);
    }
    std::vector<SurfaceWeight> weights;
    std::vector<std::uint32_t> vertices;
    for (const auto& [vertex, indices] : at_vertex) {
        weights.push_back({place_of(vertex), static_cast<double>(indices.size()), 0.0});
        vertices.push_back(vertex);
    }
    return at_vertex[vertices[geodesic_median(*field_, weights).index]];
}

} // namespace overt
