#include "experiment/surface/surface_smoother.h"

#include <algorithm>

#include "experiment/base/error.h"
#include "experiment/base/parallel.h"
#include "experiment/surface/heat_flow.h"

namespace overt {
namespace {

double heat_time(double sigma_mm) { return 0.5 * sigma_mm * sigma_mm; }

// Areas on the diagonal, plus the step times the cotangent weights.
SparseFactor factor_of_step(const SurfaceGeometry& geometry, double step) {
    const std::vector<IntrinsicTriangulation::EdgeWeight> weights = geometry.triangulation().edge_weights();
    std::vector<double> diagonal(geometry.node_areas_mm2().begin(), geometry.node_areas_mm2().end());
    std::vector<MatrixEntry> entries;
    entries.reserve(diagonal.size() + weights.size());
    for (const auto& [a, b, weight] : weights) {
        diagonal[a] += step * weight;
        diagonal[b] += step * weight;
        entries.push_back({std::max(a, b), std::min(a, b), -step * weight});
    }
    for (std::uint32_t node = 0; node < diagonal.size(); ++node) {
        // A node of no triangle keeps what it has.
        entries.push_back({node, node, diagonal[node] > 0.0 ? diagonal[node] : 1.0});
    }
    return {dissection_order(geometry.node_positions_mm(), entries), entries};
}

// A weight with its share in each step.
struct Source {
    std::size_t map;
    glm::uvec3 nodes;
    glm::dvec3 masses;
    std::vector<double> steps;
};

} // namespace

SurfaceSmoother::SurfaceSmoother(const SurfaceGeometry& geometry, double widest_sigma_mm)
    : geometry_(geometry), widest_sigma_mm_(widest_sigma_mm), times_(heat_time(widest_sigma_mm)),
      factor_(factor_of_step(geometry, times_.step())) {
    OVERT_EXPECTS(widest_sigma_mm > 0.0);
}

std::vector<std::vector<double>>
SurfaceSmoother::densities_together(std::span<const std::vector<SurfaceWeight>> maps) const {
    constexpr std::size_t together = SparseFactor::together;
    std::vector<Source> sources;
    for (std::size_t map = 0; map < maps.size(); ++map) {
        for (const SurfaceWeight& weight : maps[map]) {
            OVERT_EXPECTS(6.0 * weight.sigma_mm >= widest_sigma_mm_ && weight.sigma_mm <= widest_sigma_mm_);
            sources.push_back({map, geometry_.corners(weight.place.triangle),
                               weight.weight * weight.place.barycentric,
                               times_.weights(heat_time(weight.sigma_mm))});
        }
    }
    const std::span<const double> areas = geometry_.node_areas_mm2();
    const auto add_sources = [&](std::vector<double>& mass, std::size_t k) {
        for (const Source& source : sources) {
            for (int corner = 0; corner < 3; ++corner)
                mass[together * source.nodes[corner] + source.map] += source.steps[k] * source.masses[corner];
        }
    };
    const auto multiply = [&](std::vector<double>& densities) {
        for (std::size_t node = 0; node < areas.size(); ++node) {
            for (std::size_t i = together * node; i < together * (node + 1); ++i)
                densities[i] *= areas[node];
        }
    };
    const std::vector<double> mass = heat_densities(factor_, multiply, add_sources);
    std::vector<std::vector<double>> results;
    std::vector<double> of_nodes(areas.size());
    for (std::size_t map = 0; map < maps.size(); ++map) {
        // Rounding leaves some 1e-17 of the peak below 0 far away. A node of no triangle has no density.
        for (std::uint32_t node = 0; node < areas.size(); ++node)
            of_nodes[node] =
                geometry_.neighbours(node).empty() ? 0.0 : std::max(0.0, mass[together * node + map]);
        results.push_back(geometry_.at_vertices(of_nodes));
    }
    return results;
}

std::vector<std::vector<double>> SurfaceSmoother::densities(std::span<const std::vector<SurfaceWeight>> maps,
                                                            int most_threads) const {
    constexpr std::size_t together = SparseFactor::together;
    std::vector<std::vector<double>> results(maps.size());
    const auto batches = static_cast<int>((maps.size() + together - 1) / together);
    parallel_for(
        batches,
        [&](int batch) {
            const std::size_t begin = static_cast<std::size_t>(batch) * together;
            const std::size_t count = std::min(together, maps.size() - begin);
            std::ranges::move(densities_together(maps.subspan(begin, count)),
                              results.begin() + static_cast<std::ptrdiff_t>(begin));
        },
        most_threads);
    return results;
}

std::vector<double> SurfaceSmoother::density(std::span<const SurfaceWeight> weights) const {
    const std::vector<SurfaceWeight> map(weights.begin(), weights.end());
    return std::move(densities_together(std::span(&map, 1)).front());
}

} // namespace overt
