#include <catch2/catch.hpp>

#include "experiment/surface/coarse_surface.h"
#include "experiment/surface/surface_smoother.h"
#include "tests/experiment/surface/flat_and_round.h"
#include "tests/support/figures.h"

using namespace overt;
using namespace overt::test;

TEST_CASE("a map on a coarse surface is that on the fine one", "[unit]") {
    const Mesh mesh = icosphere(100.0, 6); // 40,962 vertices
    const SurfaceGeometry fine(mesh);
    const CoarseSurface coarse(fine, 4000);
    CHECK(coarse.vertex_count() > 3000);
    CHECK(coarse.vertex_count() < 5000);
    const SurfaceGeometry geometry(coarse.mesh());
    CHECK(geometry.total_area_mm2() == Approx(fine.total_area_mm2()).epsilon(0.01));

    std::vector<SurfaceWeight> weights, moved;
    for (std::uint32_t i = 0; i < 40; ++i) {
        weights.push_back({{i * 2003 % 81920, {0.2, 0.5, 0.3}}, 1.0 + i % 4, 20.0});
        for (const SurfaceWeight& weight : coarse.moved(weights.back()))
            moved.push_back(weight);
    }
    const std::vector<double> expected = SurfaceSmoother(fine, 20.0).density(weights);
    const std::vector<double> density = SurfaceSmoother(geometry, 20.0).density(moved);
    CHECK(mass_of(density, geometry) == Approx(mass_of(expected, fine)).epsilon(1e-9));
    const double peak = *std::max_element(expected.begin(), expected.end());
    for (std::uint32_t v = 0; v < density.size(); ++v)
        REQUIRE(density[v] == Approx(expected[coarse.fine_node_of(v)]).margin(0.1 * peak));
}

TEST_CASE("a surface that is coarse enough stays as it is", "[unit]") {
    Mesh mesh = flat_square(1.0, 4);
    add_part(mesh, flat_square(1.0, 4, 1.0), "lid");
    const SurfaceGeometry fine(mesh, 10.0);
    const CoarseSurface coarse(fine, 1000);
    CHECK(coarse.vertex_count() == mesh.positions.size());
    CHECK(coarse.mesh().triangles.size() == mesh.triangles.size());
    double edges = 0.0;
    for (const glm::uvec3& t : coarse.mesh().triangles)
        for (int k = 0; k < 3; ++k)
            edges += glm::distance(coarse.mesh().positions[t[k]], coarse.mesh().positions[t[(k + 1) % 3]]);
    CHECK(edges / static_cast<double>(mesh.triangles.size()) == Approx(5.0 + 5.0 + 5.0 * std::sqrt(2.0)));
    for (std::uint32_t node = 0; node < fine.node_count(); ++node)
        CHECK(coarse.fine_node_of(coarse.vertex_near(node)) == node);
}

TEST_CASE("a surface in another unit keeps the same nodes where they are chosen at the same size", "[unit]") {
    const Mesh mesh = icosphere(100.0, 5);
    const SurfaceGeometry in_mm(mesh, 1.0), in_tenths(mesh, 0.104103770465);
    const CoarseSurface shown(in_tenths, 700), own(in_mm, 700, 0.104103770465);
    REQUIRE(own.vertex_count() == shown.vertex_count());
    REQUIRE(own.vertex_count() < 1000);
    for (std::uint32_t v = 0; v < own.vertex_count(); ++v) {
        REQUIRE(own.fine_node_of(v) == shown.fine_node_of(v));
        REQUIRE(own.mesh().positions[v] == mesh.positions[own.fine_node_of(v)]);
    }
    CHECK(own.mesh().triangles == shown.mesh().triangles);
}
