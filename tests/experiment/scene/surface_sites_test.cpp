#include "experiment/scene/surface_sites.h"

#include <algorithm>
#include <numbers>

#include <catch2/catch.hpp>

#include "tests/experiment/surface/flat_and_round.h"

using namespace overt;
using namespace overt::test;

namespace {

double nearest_pair(const Mesh& mesh, const std::vector<SurfaceSite>& sites) {
    double nearest = 1e9;
    for (std::size_t i = 0; i < sites.size(); ++i)
        for (std::size_t k = i + 1; k < sites.size(); ++k)
            nearest =
                std::min(nearest, glm::distance(position_of(mesh, sites[i]), position_of(mesh, sites[k])));
    return nearest;
}

bool is_in_triangle(const SurfaceSite& site) {
    const glm::dvec3& w = site.barycentric;
    return w.x >= 0.0 && w.y >= 0.0 && w.z >= 0.0 && std::abs(w.x + w.y + w.z - 1.0) < 1e-12;
}

} // namespace

TEST_CASE("spread places lie on the surface, apart from each other, and each piece has its share", "[unit]") {
    const Mesh mesh = icosphere(10.0, 3);
    const std::vector<SurfaceSite> sites = spread_sites(mesh, 120, 4, {}, {});
    REQUIRE(sites.size() == 120);
    CHECK(std::ranges::all_of(sites, is_in_triangle));
    // 120 discs on the sphere in the densest packing have this diameter; by chance alone the nearest two of
    // 120 places lie at about a thirtieth of it.
    const double densest =
        2.0 * std::sqrt(4.0 * std::numbers::pi * 100.0 / (2.0 * std::numbers::sqrt3 * 120.0));
    CHECK(nearest_pair(mesh, sites) > 0.55 * densest);
    for (int axis = 0; axis < 3; ++axis) {
        const auto upper = std::ranges::count_if(
            sites, [&](const SurfaceSite& site) { return position_of(mesh, site)[axis] > 0.0; });
        CHECK(upper >= 54); // of 60; by chance alone 49 to 71
        CHECK(upper <= 66);
    }
}

TEST_CASE("large triangles have more of the places than small ones", "[unit]") {
    // Two squares of area 1 and 9, each of two triangles.
    Mesh mesh;
    for (const float side : {1.0f, 3.0f}) {
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        const float x = side == 1.0f ? 0.0f : 10.0f;
        mesh.positions.insert(mesh.positions.end(),
                              {{x, 0, 0}, {x + side, 0, 0}, {x + side, side, 0}, {x, side, 0}});
        mesh.triangles.insert(mesh.triangles.end(),
                              {{first, first + 1, first + 2}, {first, first + 2, first + 3}});
    }
    const std::vector<SurfaceSite> sites = spread_sites(mesh, 100, 1, {}, {});
    const auto on_small =
        std::ranges::count_if(sites, [](const SurfaceSite& site) { return site.triangle < 2; });
    CHECK(on_small >= 8);
    CHECK(on_small <= 16); // a rim counts more on the small one: what is outside has no neighbours
}

TEST_CASE("places are the same for a seed, others for another, and only where they are wanted", "[unit]") {
    const Mesh mesh = icosphere(1.0, 2);
    const auto same = [](const std::vector<SurfaceSite>& a, const std::vector<SurfaceSite>& b) {
        return std::ranges::equal(a, b, [](const SurfaceSite& one, const SurfaceSite& other) {
            return one.triangle == other.triangle && one.barycentric == other.barycentric;
        });
    };
    CHECK(same(spread_sites(mesh, 20, 1, {}, {}), spread_sites(mesh, 20, 1, {}, {})));
    CHECK_FALSE(same(spread_sites(mesh, 20, 1, {}, {}), spread_sites(mesh, 20, 2, {}, {})));
    const auto is_high = [&](const SurfaceSite& site) { return position_of(mesh, site).z > 0.5; };
    const std::vector<SurfaceSite> high = spread_sites(mesh, 20, 1, {}, is_high);
    REQUIRE(high.size() == 20);
    CHECK(std::ranges::all_of(high, is_high));
    const std::vector<SurfaceSite> few =
        spread_sites(mesh, 20, 1, [](std::uint32_t triangle) { return triangle == 3; }, {});
    CHECK(std::ranges::all_of(few, [](const SurfaceSite& site) { return site.triangle == 3; }));
    CHECK(spread_sites(mesh, 20, 1, {}, [](const SurfaceSite&) { return false; }).empty());
}

TEST_CASE("a vertex, and the nearest place, are found", "[unit]") {
    const Mesh mesh = flat_square(1.0, 2);
    for (std::uint32_t vertex = 0; vertex < mesh.positions.size(); ++vertex) {
        const std::optional<SurfaceSite> site = site_of_vertex(mesh, vertex);
        REQUIRE(site);
        CHECK(position_of(mesh, *site) == glm::dvec3(mesh.positions[vertex]));
    }
    CHECK_FALSE(site_of_vertex(mesh, 9));
    // Above the square, beside an edge, and beyond a corner.
    CHECK(glm::distance(position_of(mesh, nearest_site(mesh, {0.3, -0.4, 5.0})), {0.3, -0.4, 0.0}) < 1e-6);
    CHECK(glm::distance(position_of(mesh, nearest_site(mesh, {3.0, 0.25, 1.0})), {1.0, 0.25, 0.0}) < 1e-6);
    CHECK(glm::distance(position_of(mesh, nearest_site(mesh, {-4.0, 7.0, 0.0})), {-1.0, 1.0, 0.0}) < 1e-6);
}

TEST_CASE("normals point outwards, and are shaded between the corners'", "[unit]") {
    const Mesh mesh = icosphere(5.0, 3);
    const std::vector<glm::vec3> normals = mesh.vertex_normals();
    for (const SurfaceSite& site : spread_sites(mesh, 50, 3, {}, {})) {
        const glm::dvec3 out = glm::normalize(position_of(mesh, site));
        CHECK(glm::dot(normal_of_triangle(mesh, site.triangle), out) > 0.98);
        CHECK(glm::dot(shading_normal_of(mesh, normals, site), out) > 0.9998);
    }
}
