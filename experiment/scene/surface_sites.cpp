#include "experiment/scene/surface_sites.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <set>
#include <utility>

#include "experiment/base/random.h"

namespace overt {

namespace {

/// As many are drawn for each that stays; Yuksel found little use in more.
constexpr std::size_t drawn_for_each = 10;
/// So many draws are tried for each before the search for places that are wanted is given up.
constexpr std::size_t most_tries = 400;

struct TriangleCorners {
    glm::dvec3 a, b, c;
};

TriangleCorners triangle_corners(const Mesh& mesh, std::uint32_t triangle) {
    const glm::uvec3& of = mesh.triangles[triangle];
    return {mesh.positions[of.x], mesh.positions[of.y], mesh.positions[of.z]};
}

double site_area(const TriangleCorners& corners) {
    return 0.5 * glm::length(glm::cross(corners.b - corners.a, corners.c - corners.a));
}

/// The nearest place of a triangle, after Ericson, "Real-Time Collision Detection", 2005, section 5.1.5: in
/// the region of a corner, of an edge, or inside.
glm::dvec3 nearest_weights(const TriangleCorners& of, const glm::dvec3& p) {
    const glm::dvec3 ab = of.b - of.a, ac = of.c - of.a, ap = p - of.a, bp = p - of.b, cp = p - of.c;
    const double d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap), d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp),
                 d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
    if (d1 <= 0.0 && d2 <= 0.0)
        return {1.0, 0.0, 0.0};
    if (d3 >= 0.0 && d4 <= d3)
        return {0.0, 1.0, 0.0};
    if (d6 >= 0.0 && d5 <= d6)
        return {0.0, 0.0, 1.0};
    const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
    if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) {
        const double v = d1 / (d1 - d3);
        return {1.0 - v, v, 0.0};
    }
    if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) {
        const double w = d2 / (d2 - d6);
        return {1.0 - w, 0.0, w};
    }
    if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) {
        const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return {0.0, 1.0 - w, w};
    }
    const double sum = va + vb + vc;
    return {va / sum, vb / sum, vc / sum};
}

/// Leaves `count` of the places, those that lie farthest from others. `area`: that they are spread over.
std::vector<std::size_t> eliminated(const std::vector<glm::dvec3>& places, std::size_t count, double area) {
    // Radius of the discs if `count` of them covered a plane of that area in the densest packing.
    const double largest = std::sqrt(area / (2.0 * std::numbers::sqrt3 * static_cast<double>(count)));
    // What is nearer than that counts alike (Yuksel's equation 3 with his gamma and beta).
    const double share = static_cast<double>(count) / static_cast<double>(places.size());
    const double least = largest * (1.0 - std::pow(share, 1.5)) * 0.65;
    const auto weight = [&](double distance) {
        return std::pow(std::max(0.0, 1.0 - std::max(distance, 2.0 * least) / (2.0 * largest)), 8.0);
    };
    // Neighbours lie in a slice along x.
    std::vector<std::size_t> by_x(places.size());
    std::iota(by_x.begin(), by_x.end(), std::size_t{0});
    std::ranges::sort(by_x, [&](std::size_t one, std::size_t other) {
        return std::pair(places[one].x, one) < std::pair(places[other].x, other);
    });
    std::vector<std::vector<std::pair<std::size_t, double>>> neighbours(places.size());
    std::vector<double> crowd(places.size(), 0.0);
    for (std::size_t i = 0; i < by_x.size(); ++i) {
        for (std::size_t k = i + 1; k < by_x.size(); ++k) {
            const std::size_t one = by_x[i], other = by_x[k];
            if (places[other].x - places[one].x >= 2.0 * largest)
                break;
            const double distance = glm::distance(places[one], places[other]);
            if (distance >= 2.0 * largest)
                continue;
            const double of_pair = weight(distance);
            neighbours[one].emplace_back(other, of_pair);
            neighbours[other].emplace_back(one, of_pair);
            crowd[one] += of_pair;
            crowd[other] += of_pair;
        }
    }
    std::set<std::pair<double, std::size_t>> left;
    for (std::size_t i = 0; i < places.size(); ++i)
        left.emplace(crowd[i], i);
    std::vector<bool> is_out(places.size());
    while (left.size() > count) {
        const std::size_t most = left.rbegin()->second;
        left.erase(std::prev(left.end()));
        is_out[most] = true;
        for (const auto& [neighbour, of_pair] : neighbours[most]) {
            if (is_out[neighbour])
                continue;
            left.erase({crowd[neighbour], neighbour});
            crowd[neighbour] -= of_pair;
            left.emplace(crowd[neighbour], neighbour);
        }
    }
    std::vector<std::size_t> stay;
    for (std::size_t i = 0; i < places.size(); ++i)
        if (!is_out[i])
            stay.push_back(i);
    return stay;
}

} // namespace

glm::dvec3 position_of(const Mesh& mesh, const SurfaceSite& site) {
    const TriangleCorners of = triangle_corners(mesh, site.triangle);
    return site.barycentric.x * of.a + site.barycentric.y * of.b + site.barycentric.z * of.c;
}

glm::dvec3 normal_of_triangle(const Mesh& mesh, std::uint32_t triangle) {
    const TriangleCorners of = triangle_corners(mesh, triangle);
    const glm::dvec3 normal = glm::cross(of.b - of.a, of.c - of.a);
    const double length = glm::length(normal);
    return length > 0.0 ? normal / length : glm::dvec3(0.0, 0.0, 1.0);
}

glm::dvec3 shading_normal_of(const Mesh& mesh, const std::vector<glm::vec3>& vertex_normals,
                             const SurfaceSite& site) {
    glm::dvec3 sum(0.0);
    for (int corner = 0; corner < 3; ++corner)
        sum += site.barycentric[corner] * glm::dvec3(vertex_normals[mesh.triangles[site.triangle][corner]]);
    const double length = glm::length(sum);
    return length > 0.0 ? sum / length : normal_of_triangle(mesh, site.triangle);
}

std::optional<SurfaceSite> site_of_vertex(const Mesh& mesh, std::uint32_t vertex) {
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
        for (int corner = 0; corner < 3; ++corner)
            if (mesh.triangles[i][corner] == vertex) {
                SurfaceSite site{static_cast<std::uint32_t>(i), glm::dvec3(0.0)};
                site.barycentric[corner] = 1.0;
                return site;
            }
    return std::nullopt;
}

SurfaceSite nearest_of_triangle(const Mesh& mesh, std::uint32_t triangle, const glm::dvec3& position) {
    return {triangle, nearest_weights(triangle_corners(mesh, triangle), position)};
}

SurfaceSite nearest_site(const Mesh& mesh, const glm::dvec3& position) {
    SurfaceSite best;
    double least = std::numeric_limits<double>::infinity();
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
        const SurfaceSite site = nearest_of_triangle(mesh, i, position);
        const glm::dvec3 off = position_of(mesh, site) - position;
        if (const double squared = glm::dot(off, off); squared < least) {
            least = squared;
            best = site;
        }
    }
    return best;
}

std::vector<SurfaceSite> spread_sites(const Mesh& mesh, std::size_t count, std::uint64_t seed,
                                      const std::function<bool(std::uint32_t triangle)>& takes_triangle,
                                      const std::function<bool(const SurfaceSite&)>& takes_site) {
    std::vector<std::uint32_t> triangles;
    std::vector<double> area_up_to;
    double area = 0.0;
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
        if (takes_triangle && !takes_triangle(i))
            continue;
        area += site_area(triangle_corners(mesh, i));
        triangles.push_back(i);
        area_up_to.push_back(area);
    }
    std::vector<SurfaceSite> drawn;
    if (!(area > 0.0) || count == 0)
        return drawn;
    RandomStream random(seed, "places on the surface");
    const std::size_t wanted = drawn_for_each * count;
    std::size_t tries = 0;
    for (; drawn.size() < wanted && tries < most_tries * count; ++tries) {
        const auto at = std::ranges::upper_bound(area_up_to, random.uniform() * area);
        const auto index =
            std::min<std::size_t>(static_cast<std::size_t>(at - area_up_to.begin()), triangles.size() - 1);
        // Uniform in a triangle: Osada, Funkhouser, Chazelle and Dobkin, "Shape distributions", 2002.
        const double root = std::sqrt(random.uniform()), along = random.uniform();
        const SurfaceSite site{triangles[index], {1.0 - root, root * (1.0 - along), root * along}};
        if (!takes_site || takes_site(site))
            drawn.push_back(site);
    }
    if (drawn.size() <= count)
        return drawn;
    std::vector<glm::dvec3> places;
    for (const SurfaceSite& site : drawn)
        places.push_back(position_of(mesh, site));
    const double taken_area = area * static_cast<double>(drawn.size()) / static_cast<double>(tries);
    std::vector<SurfaceSite> spread;
    for (const std::size_t i : eliminated(places, count, taken_area))
        spread.push_back(drawn[i]);
    return spread;
}

} // namespace overt
