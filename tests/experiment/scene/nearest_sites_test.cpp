#include "experiment/scene/nearest_sites.h"

#include <catch2/catch.hpp>

#include "experiment/base/random.h"
#include "tests/experiment/surface/flat_and_round.h"

using namespace overt;
using namespace overt::test;

TEST_CASE("the tree finds the nearest place that looking at every triangle finds, near and far", "[unit]") {
    // Far from the origin, where floats are coarse.
    Mesh mesh = icosphere(10.0, 3);
    for (glm::vec3& position : mesh.positions)
        position += glm::vec3(2000.0f, -500.0f, 40.0f);
    const NearestSites sites(mesh);
    RandomStream random(5, "positions");
    for (const double spread : {1e-3, 5.0, 12.0, 1e4}) {
        for (int i = 0; i < 60; ++i) {
            const glm::dvec3 position =
                glm::dvec3(2000.0, -500.0, 40.0) +
                spread * glm::dvec3(random.normal(), random.normal(), random.normal());
            const SurfaceSite found = sites.nearest(position), wanted = nearest_site(mesh, position);
            CHECK(found.triangle == wanted.triangle);
            CHECK(found.barycentric == wanted.barycentric);
        }
    }
    // At a vertex several triangles are alike near.
    for (std::uint32_t v = 0; v < mesh.positions.size(); v += 7)
        CHECK(sites.nearest(glm::dvec3(mesh.positions[v])).triangle ==
              nearest_site(mesh, glm::dvec3(mesh.positions[v])).triangle);
}

TEST_CASE("only triangles that are taken count, by their numbers in the mesh", "[unit]") {
    const Mesh square = flat_square(5.0, 10);
    const auto is_right = [&](std::uint32_t triangle) {
        return square.positions[square.triangles[triangle].x].x > 0.99f;
    };
    const NearestSites right(square, is_right);
    const SurfaceSite found = right.nearest({-4.0, 2.5, 1.0});
    CHECK(is_right(found.triangle));
    CHECK(glm::distance(position_of(square, found), glm::dvec3(1.0, 2.5, 0.0)) < 1e-12);
    CHECK(glm::distance(position_of(square, right.nearest({3.25, -7.0, 0.0})), glm::dvec3(3.25, -5.0, 0.0)) <
          1e-12);
}
