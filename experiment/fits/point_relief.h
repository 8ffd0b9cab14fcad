/// The relief that gradients at single places speak of, without a triangulation given beforehand.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace overt {

/// A place, and how some height rises there.
struct ReliefSite {
    double x = 0.0, y = 0.0;
    double rise_x = 0.0, rise_y = 0.0; ///< of the height for a unit of x and y
};

/// Two neighbours, by their index.
using ReliefEdge = std::array<std::size_t, 2>;

/// The edges of the Delaunay triangulation (Bowyer 1981, Watson 1981), each once; without those that are
/// longer than `longest` times the median of all, which lie along the outline or across a gap, unless places
/// would lose their connection. None of fewer than three places, or of places on one line.
std::vector<ReliefEdge> neighbours_among(std::span<const ReliefSite> sites, double longest = 2.5);

struct PointRelief {
    std::vector<double> height;    ///< by site, with a mean of 0
    double residual_rms = 0.0;     ///< over edges
    std::vector<ReliefEdge> edges; ///< that were taken
};

/// Least squares over edges: from one neighbour to the other the height rises by the mean of both rises along
/// the way between them, which is exact where the height is a polynomial of second degree. Nothing if the
/// edges do not connect all sites.
std::optional<PointRelief> point_relief(std::span<const ReliefSite> sites);

} // namespace overt
