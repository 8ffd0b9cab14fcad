/// How points scatter in space: the paper's compactness of fixations.
#pragma once

#include <optional>
#include <span>

#include <glm/glm.hpp>

namespace overt {

/// Equation 3 of Sidorov, Harvey, Smithson and Hardeberg 2019: the mean within-cluster sum of squares of
/// points that are one cluster, which is the sum of the variances along the axes, each divided by N (not N -
/// 1).
struct PointSpread {
    glm::dvec3 mean{0.0};
    glm::dvec3 variance{0.0}; ///< in the square of the points' unit
    double wss() const { return variance.x + variance.y + variance.z; }
};

/// Nothing without points.
std::optional<PointSpread> point_spread(std::span<const glm::dvec3> points);

/// The sum of the variances along the axes, each divided by N - 1: what does not grow with the number of
/// points, so that of unequal numbers can be compared. Nothing with fewer than two.
std::optional<double> unbiased_wss(std::span<const glm::dvec3> points);

/// The same with weights (not negative), such as durations: variances divide by the sum of the weights.
/// Nothing if that is 0.
std::optional<PointSpread> point_spread(std::span<const glm::dvec3> points, std::span<const double> weights);

} // namespace overt
