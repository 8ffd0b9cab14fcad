#include "experiment/surface/euclidean_kernel.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "experiment/base/error.h"
#include "experiment/surface/geodesic_field.h"

namespace overt {
namespace {

constexpr double reach_sigmas = 4.0;
constexpr double leak_sigmas = 3.0;

} // namespace

EuclideanKernel::EuclideanKernel(const SurfaceGeometry& geometry) : geometry_(geometry) {
    const std::span<const glm::dvec3> positions = geometry.node_positions_mm();
    if (positions.empty())
        return;
    glm::dvec3 low = positions.front(), high = low;
    for (const glm::dvec3& position : positions) {
        low = glm::min(low, position);
        high = glm::max(high, position);
    }
    // About four nodes to each cell that the surface meets.
    origin_ = low;
    cell_mm_ = std::max({1e-9, glm::length(high - low) / 256.0,
                         std::sqrt(4.0 * geometry.total_area_mm2() / double(positions.size()))});
    cells_ = glm::ivec3((high - low) / cell_mm_) + 1;
    const auto cell_of = [&](const glm::dvec3& position) {
        const glm::ivec3 at = glm::min(glm::ivec3((position - origin_) / cell_mm_), cells_ - 1);
        return static_cast<std::size_t>((at.z * cells_.y + at.y) * cells_.x + at.x);
    };
    begin_.assign(static_cast<std::size_t>(cells_.x * cells_.y * cells_.z) + 1, 0);
    for (const glm::dvec3& position : positions)
        ++begin_[cell_of(position) + 1];
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    nodes_.resize(positions.size());
    std::vector<std::size_t> next(begin_.begin(), begin_.end());
    for (std::uint32_t node = 0; node < positions.size(); ++node)
        nodes_[next[cell_of(positions[node])]++] = node;
}

template <class Visit>
void EuclideanKernel::for_each_near(const glm::dvec3& place, double radius, const Visit& visit) const {
    const glm::ivec3 first = glm::max(glm::ivec3(glm::floor((place - radius - origin_) / cell_mm_)), 0);
    const glm::ivec3 last =
        glm::min(glm::ivec3(glm::floor((place + radius - origin_) / cell_mm_)), cells_ - 1);
    for (int z = first.z; z <= last.z; ++z) {
        for (int y = first.y; y <= last.y; ++y) {
            // The cells of a row lie one after another.
            const auto row = static_cast<std::size_t>((z * cells_.y + y) * cells_.x);
            for (std::size_t i = begin_[row + static_cast<std::size_t>(first.x)];
                 first.x <= last.x && i < begin_[row + static_cast<std::size_t>(last.x) + 1]; ++i) {
                const glm::dvec3 away = geometry_.node_positions_mm()[nodes_[i]] - place;
                const double squared = glm::dot(away, away);
                if (squared <= radius * radius)
                    visit(nodes_[i], squared);
            }
        }
    }
}

double EuclideanKernel::spread(const glm::dvec3& place, double sigma_mm,
                               std::vector<std::pair<std::uint32_t, double>>& nodes) const {
    OVERT_EXPECTS(sigma_mm > 0.0);
    nodes.clear();
    const std::span<const double> areas = geometry_.node_areas_mm2();
    double sum = 0.0;
    for_each_near(place, reach_sigmas * sigma_mm, [&](std::uint32_t node, double squared) {
        const double value = std::exp(-0.5 * squared / (sigma_mm * sigma_mm));
        nodes.emplace_back(node, value);
        sum += value * areas[node];
    });
    return sum;
}

std::vector<double> EuclideanKernel::leaked_shares(const SurfacePlace& place,
                                                   std::span<const double> sigmas_mm) const {
    std::vector<double> shares;
    if (sigmas_mm.empty())
        return shares;
    GeodesicField field(geometry_);
    field.spread_from(place, leak_sigmas * std::ranges::max(sigmas_mm));
    const std::span<const double> areas = geometry_.node_areas_mm2();
    std::vector<std::pair<std::uint32_t, double>> nodes;
    for (const double sigma_mm : sigmas_mm) {
        const double sum = spread(geometry_.position_mm(place), sigma_mm, nodes);
        double leaked = 0.0;
        for (const auto& [node, value] : nodes)
            leaked += field.to_node(node) < leak_sigmas * sigma_mm ? 0.0 : value * areas[node];
        shares.push_back(sum > 0.0 ? leaked / sum : 0.0);
    }
    return shares;
}

std::vector<double> EuclideanKernel::density(std::span<const SurfaceWeight> weights) const {
    const std::span<const double> areas = geometry_.node_areas_mm2();
    std::vector<double> density(geometry_.node_count(), 0.0);
    std::vector<std::pair<std::uint32_t, double>> nodes;
    for (const SurfaceWeight& weight : weights) {
        const double sum = spread(geometry_.position_mm(weight.place), weight.sigma_mm, nodes);
        if (sum <= 0.0) {
            const glm::uvec3& corners = geometry_.corners(weight.place.triangle);
            for (int k = 0; k < 3; ++k) {
                if (areas[corners[k]] > 0.0)
                    density[corners[k]] += weight.weight * weight.place.barycentric[k] / areas[corners[k]];
            }
            continue;
        }
        for (const auto& [node, value] : nodes)
            density[node] += weight.weight * value / sum;
    }
    return geometry_.at_vertices(density);
}

} // namespace overt
