#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "experiment/base/error.h"
#include "experiment/surface/geodesic_field.h"

namespace overt {
namespace {

/// Steps of Weiszfeld's iteration; it need only lead to the right place among some.
constexpr int weiszfeld_steps = 30;
/// Places that are compared where the straight median does not decide.
constexpr std::size_t most_compared = 16;

// The weighted median in space, by Weiszfeld's iteration from the mean.
glm::dvec3 median_in_space(std::span<const glm::dvec3> positions, std::span<const SurfaceWeight> weights) {
    glm::dvec3 place(0.0);
    double sum = 0.0;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        place += weights[i].weight * positions[i];
        sum += weights[i].weight;
    }
    place /= sum;
    for (int step = 0; step < weiszfeld_steps; ++step) {
        glm::dvec3 pulled(0.0);
        double pull = 0.0;
        for (std::size_t i = 0; i < weights.size(); ++i) {
            // A thousandth of a millimetre keeps the pull finite where the median lies on a place.
            const double share = weights[i].weight / std::max(1e-3, glm::distance(place, positions[i]));
            pulled += share * positions[i];
            pull += share;
        }
        place = pulled / pull;
    }
    return place;
}

// Up to most_compared places, each the one farthest from all before, beginning with `first`.
std::vector<std::size_t> spread_out(std::span<const glm::dvec3> positions, std::size_t first) {
    std::vector<std::size_t> chosen{first};
    std::vector<double> away(positions.size(), GeodesicField::unreached);
    while (chosen.size() < std::min(most_compared, positions.size())) {
        for (std::size_t i = 0; i < positions.size(); ++i)
            away[i] = std::min(away[i], glm::distance(positions[i], positions[chosen.back()]));
        const auto farthest = std::max_element(away.begin(), away.end());
        if (*farthest <= 0.0)
            break;
        chosen.push_back(static_cast<std::size_t>(farthest - away.begin()));
    }
    return chosen;
}

/// Which places have a node at a corner of their triangle.
class Corners {
  public:
    using OfNode = std::pair<std::uint32_t, std::size_t>; ///< the node and the place's index

    Corners(const SurfaceGeometry& geometry, std::span<const SurfaceWeight> weights) {
        for (std::size_t i = 0; i < weights.size(); ++i) {
            for (int k = 0; k < 3; ++k)
                all_.emplace_back(geometry.corners(weights[i].place.triangle)[k], i);
        }
        std::ranges::sort(all_);
    }
    std::span<const OfNode> at(std::uint32_t node) const {
        return {std::ranges::lower_bound(all_, node, {}, &OfNode::first),
                std::ranges::upper_bound(all_, node, {}, &OfNode::first)};
    }

  private:
    std::vector<OfNode> all_;
};

} // namespace

GeodesicMedian geodesic_median(GeodesicField& field, std::span<const SurfaceWeight> weights,
                               double tolerance) {
    const SurfaceGeometry& geometry = field.geometry();
    std::vector<glm::dvec3> positions;
    for (const SurfaceWeight& weight : weights)
        positions.push_back(geometry.position_mm(weight.place));
    double whole = 0.0;
    for (const SurfaceWeight& weight : weights)
        whole += weight.weight;
    OVERT_EXPECTS(whole > 0.0);

    const glm::dvec3 middle = median_in_space(positions, weights);
    std::size_t nearest = 0;
    double widest = 0.0;
    for (std::size_t i = 0; i < positions.size(); ++i) {
        if (weights[i].weight > 0.0 &&
            (weights[nearest].weight <= 0.0 ||
             glm::distance(positions[i], middle) < glm::distance(positions[nearest], middle)))
            nearest = i;
        widest = std::max(widest, glm::distance(positions[i], middle));
    }
    // Beyond that a way is counted as this long: it leads around, and how far around says little.
    const double reach = std::max(1e-3, 6.0 * widest);
    const Corners corners(geometry, weights);
    double straight_sum = 0.0;
    // Given up as soon as it cannot be below `most`.
    const auto sum_from = [&](std::size_t candidate, double most) -> std::optional<GeodesicMedian> {
        GeodesicMedian median{candidate, 0.0, 0.0};
        straight_sum = 0.0;
        std::vector<double> straight;
        for (std::size_t i = 0; i < weights.size(); ++i) {
            straight.push_back(weights[i].weight * glm::distance(positions[i], positions[candidate]) / whole);
            straight_sum += straight.back();
        }
        if (straight_sum >= most)
            return std::nullopt;
        // No way is shorter than the straight one, nor, as long as no corner of its place is reached, than
        // what has been gone over.
        std::vector<int> left(weights.size(), 3);
        std::size_t open = weights.size();
        double least = 0.0, untouched = 1.0;
        const SurfacePlace& source = weights[candidate].place;
        field.spread_until(source, reach, [&](std::uint32_t node, double distance) {
            for (const auto& [corner, i] : corners.at(node)) {
                if (left[i] == 3) {
                    untouched -= weights[i].weight / whole;
                    least += straight[i];
                }
                open -= --left[i] == 0;
            }
            return open == 0 || least + untouched * distance >= most;
        });
        if (open > 0 && least + untouched * reach >= most)
            return std::nullopt;
        for (const SurfaceWeight& one : weights) {
            const double way = field.to(one.place);
            const bool is_reached = way < GeodesicField::unreached;
            median.mean_distance_mm += one.weight * (is_reached ? way : reach) / whole;
            if (!is_reached)
                median.unreached_share += one.weight / whole;
        }
        return median;
    };
    GeodesicMedian best = *sum_from(nearest, GeodesicField::unreached);
    if (best.mean_distance_mm <= (1.0 + tolerance) * straight_sum + 1e-9)
        return best;
    for (const std::size_t candidate : spread_out(positions, nearest)) {
        if (candidate == nearest || weights[candidate].weight <= 0.0)
            continue;
        const std::optional<GeodesicMedian> other = sum_from(candidate, best.mean_distance_mm);
        if (other && other->mean_distance_mm < best.mean_distance_mm)
            best = *other;
    }
    return best;
}

} // namespace overt
