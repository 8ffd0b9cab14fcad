#include "experiment/statistics/point_spread.h"

#include <vector>

namespace overt {

std::optional<PointSpread> point_spread(std::span<const glm::dvec3> points) {
    return point_spread(points, std::vector<double>(points.size(), 1.0));
}

std::optional<double> unbiased_wss(std::span<const glm::dvec3> points) {
    if (points.size() < 2)
        return std::nullopt;
    const auto count = static_cast<double>(points.size());
    return point_spread(points)->wss() * count / (count - 1.0);
}

std::optional<PointSpread> point_spread(std::span<const glm::dvec3> points, std::span<const double> weights) {
    PointSpread spread;
    double all = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        spread.mean += weights[i] * points[i];
        all += weights[i];
    }
    if (!(all > 0.0))
        return std::nullopt;
    spread.mean /= all;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const glm::dvec3 off = points[i] - spread.mean;
        spread.variance += weights[i] * off * off;
    }
    spread.variance /= all;
    return spread;
}

} // namespace overt
