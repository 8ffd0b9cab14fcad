#include "experiment/surface/surface_samples.h"

#include <algorithm>
#include <numeric>

namespace overt {

SurfaceSamples::SurfaceSamples(const SurfaceGeometry& geometry) : geometry_(geometry) {
    nodes_.resize(geometry.node_count());
    std::iota(nodes_.begin(), nodes_.end(), 0u);
    nearest_ = nodes_;
    find_neighbours();
}

SurfaceSamples::SurfaceSamples(const SurfaceGeometry& geometry, const SurfaceHats& hats)
    : geometry_(geometry), hats_(&hats), nearest_(geometry.node_count(), none) {
    for (std::uint32_t hat = 0; hat < hats.count(); ++hat)
        nodes_.push_back(hats.centre(hat));
    for (std::uint32_t node = 0; node < nearest_.size(); ++node) {
        // All hats are as wide, so the highest is the nearest.
        const auto shares = hats.at(node);
        const auto highest = std::ranges::max_element(shares, {}, &SurfaceHats::Share::value);
        if (highest != shares.end())
            nearest_[node] = highest->hat;
    }
    find_neighbours();
}

std::vector<double> SurfaceSamples::areas_mm2(std::span<const char> counts) const {
    const std::span<const double> of_nodes = geometry_.node_areas_mm2();
    std::vector<double> areas(nodes_.size(), 0.0);
    for (std::uint32_t node = 0; node < of_nodes.size(); ++node) {
        if (!counts.empty() && !counts[node])
            continue;
        if (!hats_) {
            areas[node] = of_nodes[node];
            continue;
        }
        for (const SurfaceHats::Share& share : hats_->at(node))
            areas[share.hat] += share.value * of_nodes[node];
    }
    return areas;
}

void SurfaceSamples::find_neighbours() {
    std::vector<std::vector<std::uint32_t>> of_sample(nodes_.size());
    for (std::uint32_t node = 0; node < nearest_.size(); ++node) {
        const std::uint32_t own = nearest_[node];
        if (own == none)
            continue;
        for (const std::uint32_t neighbour : geometry_.neighbours(node)) {
            const std::uint32_t other = nearest_[neighbour];
            if (other != own && other != none)
                of_sample[own].push_back(other);
        }
    }
    neighbours_begin_.push_back(0);
    for (std::vector<std::uint32_t>& own : of_sample) {
        std::ranges::sort(own);
        own.erase(std::unique(own.begin(), own.end()), own.end());
        neighbours_.insert(neighbours_.end(), own.begin(), own.end());
        neighbours_begin_.push_back(static_cast<std::uint32_t>(neighbours_.size()));
    }
}

} // namespace overt
