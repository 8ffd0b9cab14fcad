#include "experiment/fits/point_relief.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include <Eigen/Dense>

namespace overt {

namespace {

struct PlanePoint {
    double x = 0.0, y = 0.0;
};

struct DelaunayTriangle {
    std::array<std::size_t, 3> corners; ///< counter-clockwise
};

double turn_of(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// The point lies inside of the circle through the corners, which run counter-clockwise.
bool is_in_circle(const std::vector<PlanePoint>& points, const DelaunayTriangle& triangle,
                  const PlanePoint& point) {
    double row[3][3];
    for (std::size_t i = 0; i < 3; ++i) {
        const PlanePoint& corner = points[triangle.corners[i]];
        row[i][0] = corner.x - point.x;
        row[i][1] = corner.y - point.y;
        row[i][2] = row[i][0] * row[i][0] + row[i][1] * row[i][1];
    }
    return row[0][0] * (row[1][1] * row[2][2] - row[1][2] * row[2][1]) -
               row[0][1] * (row[1][0] * row[2][2] - row[1][2] * row[2][0]) +
               row[0][2] * (row[1][0] * row[2][1] - row[1][1] * row[2][0]) >
           1e-12;
}

/// Within a square of side 1, so that one tolerance holds for all units.
std::vector<PlanePoint> in_unit_square(std::span<const ReliefSite> sites) {
    double low_x = sites.front().x, high_x = low_x, low_y = sites.front().y, high_y = low_y;
    for (const ReliefSite& site : sites) {
        low_x = std::min(low_x, site.x);
        high_x = std::max(high_x, site.x);
        low_y = std::min(low_y, site.y);
        high_y = std::max(high_y, site.y);
    }
    const double side = std::max({high_x - low_x, high_y - low_y, 1e-300});
    std::vector<PlanePoint> points;
    for (const ReliefSite& site : sites)
        points.push_back({(site.x - low_x) / side, (site.y - low_y) / side});
    return points;
}

std::vector<DelaunayTriangle> delaunay(std::vector<PlanePoint> points) {
    const std::size_t count = points.size();
    // A triangle far around all of them; what touches its corners is left out at the end.
    constexpr double far_away = 1e3;
    points.insert(points.end(), {{-far_away, -far_away}, {far_away, -far_away}, {0.5, far_away}});
    std::vector<DelaunayTriangle> triangles{{{count, count + 1, count + 2}}};
    for (std::size_t i = 0; i < count; ++i) {
        std::map<ReliefEdge, int> rim; // edges of what goes, in the direction of its triangles
        std::vector<DelaunayTriangle> stay;
        for (const DelaunayTriangle& triangle : triangles) {
            if (!is_in_circle(points, triangle, points[i])) {
                stay.push_back(triangle);
                continue;
            }
            for (std::size_t k = 0; k < 3; ++k)
                ++rim[{triangle.corners[k], triangle.corners[(k + 1) % 3]}];
        }
        for (const auto& [edge, times] : rim) {
            if (rim.contains({edge[1], edge[0]}) ||
                turn_of(points[edge[0]], points[edge[1]], points[i]) <= 0.0)
                continue;
            stay.push_back({{edge[0], edge[1], i}});
        }
        triangles = std::move(stay);
    }
    std::erase_if(triangles, [&](const DelaunayTriangle& triangle) {
        return std::ranges::any_of(triangle.corners, [&](std::size_t corner) { return corner >= count; });
    });
    return triangles;
}

bool connects_all(std::span<const ReliefEdge> edges, std::size_t count) {
    std::vector<std::size_t> piece(count);
    std::iota(piece.begin(), piece.end(), std::size_t{0});
    const auto root_of = [&](std::size_t one) {
        while (piece[one] != one)
            one = piece[one] = piece[piece[one]];
        return one;
    };
    std::size_t pieces = count;
    for (const auto& [from, to] : edges) {
        const std::size_t a = root_of(from), b = root_of(to);
        pieces -= a != b ? 1 : 0;
        piece[a] = b;
    }
    return pieces == 1;
}

} // namespace

std::vector<ReliefEdge> neighbours_among(std::span<const ReliefSite> sites, double longest) {
    std::vector<ReliefEdge> edges;
    if (sites.size() < 3)
        return edges;
    const std::vector<PlanePoint> points = in_unit_square(sites);
    for (const DelaunayTriangle& triangle : delaunay(points))
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t from = triangle.corners[k], to = triangle.corners[(k + 1) % 3];
            edges.push_back({std::min(from, to), std::max(from, to)});
        }
    std::ranges::sort(edges);
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    if (edges.empty())
        return edges;
    const auto length = [&](const ReliefEdge& edge) {
        return std::hypot(points[edge[1]].x - points[edge[0]].x, points[edge[1]].y - points[edge[0]].y);
    };
    std::vector<double> lengths;
    for (const ReliefEdge& edge : edges)
        lengths.push_back(length(edge));
    const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
    std::nth_element(lengths.begin(), middle, lengths.end());
    std::vector<ReliefEdge> shorter;
    for (const ReliefEdge& edge : edges)
        if (length(edge) <= longest * *middle)
            shorter.push_back(edge);
    return connects_all(shorter, sites.size()) ? shorter : edges;
}

std::optional<PointRelief> point_relief(std::span<const ReliefSite> sites) {
    PointRelief relief;
    relief.edges = neighbours_among(sites);
    if (relief.edges.empty() || !connects_all(relief.edges, sites.size()))
        return std::nullopt;
    const auto rise_along = [&](const ReliefEdge& edge) {
        const ReliefSite &from = sites[edge[0]], &to = sites[edge[1]];
        return 0.5 *
               ((from.rise_x + to.rise_x) * (to.x - from.x) + (from.rise_y + to.rise_y) * (to.y - from.y));
    };
    // The normal equations: the Laplacian of the graph, with the first site held at 0.
    const auto unknowns = static_cast<Eigen::Index>(sites.size()) - 1;
    Eigen::MatrixXd laplacian = Eigen::MatrixXd::Zero(unknowns, unknowns);
    Eigen::VectorXd flow = Eigen::VectorXd::Zero(unknowns);
    for (const ReliefEdge& edge : relief.edges) {
        const Eigen::Index from = static_cast<Eigen::Index>(edge[0]) - 1,
                           to = static_cast<Eigen::Index>(edge[1]) - 1;
        const double rise = rise_along(edge);
        if (from >= 0) {
            laplacian(from, from) += 1.0;
            flow[from] -= rise;
        }
        if (to >= 0) {
            laplacian(to, to) += 1.0;
            flow[to] += rise;
        }
        if (from >= 0 && to >= 0) {
            laplacian(from, to) -= 1.0;
            laplacian(to, from) -= 1.0;
        }
    }
    const Eigen::VectorXd solved = laplacian.ldlt().solve(flow);
    relief.height.assign(sites.size(), 0.0);
    std::copy(solved.begin(), solved.end(), relief.height.begin() + 1);
    const double mean = solved.sum() / static_cast<double>(sites.size());
    for (double& height : relief.height)
        height -= mean;
    double squares = 0.0;
    for (const ReliefEdge& edge : relief.edges) {
        const double left = relief.height[edge[1]] - relief.height[edge[0]] - rise_along(edge);
        squares += left * left;
    }
    relief.residual_rms = std::sqrt(squares / static_cast<double>(relief.edges.size()));
    return relief;
}

} // namespace overt
