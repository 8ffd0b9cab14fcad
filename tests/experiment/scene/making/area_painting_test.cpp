#include "experiment/scene/making/area_painting.h"

#include <algorithm>

#include <catch2/catch.hpp>

#include "tests/experiment/surface/flat_and_round.h"

using namespace overt;
using namespace overt::test;

namespace {

/// Two squares of 10 x 10, one a little above the other: a brush that goes by distance alone paints both.
Mesh two_sheets() {
    Mesh mesh = flat_square(5.0, 20);
    const Mesh upper = flat_square(5.0, 20, 0.2);
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), upper.positions.begin(), upper.positions.end());
    for (const glm::uvec3& triangle : upper.triangles)
        mesh.triangles.push_back(triangle + first);
    mesh.triangle_parts.assign(mesh.triangles.size(), PartIndex{0});
    return mesh;
}

std::ptrdiff_t count_of(const AreaPainting& painting, AreaPainting::Paint paint) {
    return std::ranges::count(painting.paints(), paint);
}

} // namespace

TEST_CASE("a brush paints what hangs together within its radius, and nothing on another sheet", "[unit]") {
    const Mesh mesh = two_sheets();
    AreaPainting painting(mesh);
    painting.dab(nearest_site(mesh, {1.0, 1.0, 0.0}), 2.0, 3);
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const glm::dvec3 middle = position_of(mesh, {t, glm::dvec3(1.0 / 3.0)});
        const bool is_near = middle.z < 0.1 && glm::distance(middle, glm::dvec3(1.0, 1.0, 0.0)) <= 2.0;
        CHECK(painting.paints()[t] == (is_near ? 3 : 0));
    }
    // Of a disc of radius 2 on two squares of 100.
    CHECK(painting.share(3) == Approx(3.14159 * 4.0 / 200.0).epsilon(0.05));
    CHECK(painting.share(3) + painting.share(0) == Approx(1.0));
    // Beyond the edge of the sheet nothing is near; the place's own triangle is painted however small the
    // brush.
    painting.dab(nearest_site(mesh, {-4.9, -4.9, 0.2}), 1e-6, 1);
    CHECK(count_of(painting, 1) == 1);
}

TEST_CASE("steps are taken back as they were made, each whole", "[unit]") {
    const Mesh mesh = flat_square(5.0, 10);
    AreaPainting painting(mesh);
    CHECK_FALSE(painting.undo());
    const auto states = [&] {
        return std::vector<AreaPainting::Paint>(painting.paints().begin(), painting.paints().end());
    };
    const auto bare = states();
    painting.begin_step();
    painting.dab(nearest_site(mesh, {0, 0, 0}), 2.0, 1);
    painting.dab(nearest_site(mesh, {1, 0, 0}), 2.0, 2); // over the first, within the same stroke
    const auto painted = states();
    painting.begin_step();
    painting.dab(nearest_site(mesh, {1, 0, 0}), 2.0, 2); // changes nothing, and is no step
    painting.begin_step();
    painting.dab(nearest_site(mesh, {-3, -3, 0}), 1.0, 1);
    CHECK(painting.undo());
    CHECK(states() == painted);
    CHECK(painting.undo());
    CHECK(states() == bare);
    CHECK_FALSE(painting.undo());
}

TEST_CASE("an area grows by its neighbours over edges, and shrinks by those at its border", "[unit]") {
    const Mesh mesh = flat_square(5.0, 10);
    AreaPainting painting(mesh);
    painting.dab(nearest_site(mesh, {0.5, 0.2, 0.0}), 1e-6, 2);
    REQUIRE(count_of(painting, 2) == 1);
    painting.grow(2);
    CHECK(count_of(painting, 2) == 4); // the triangle and one over each edge
    painting.shrink(2);
    CHECK(count_of(painting, 2) == 1);
    painting.shrink(2);
    CHECK(count_of(painting, 2) == 0);
    // What covers all of a mesh has no border with anything, its open edges are none.
    painting.dab(nearest_site(mesh, {0, 0, 0}), 100.0, 2);
    CHECK(count_of(painting, 2) == std::ssize(mesh.triangles));
    painting.shrink(2);
    CHECK(count_of(painting, 2) == std::ssize(mesh.triangles));
    // It grows over others, and leaves nothing but bare surface where it shrinks.
    painting.dab(nearest_site(mesh, {0, 0, 0}), 1e-6, 1);
    painting.grow(1);
    CHECK(count_of(painting, 1) == 4);
    painting.shrink(1);
    CHECK(count_of(painting, 0) == 3);
}

TEST_CASE("the other side is painted alike, about the plane that is given and no farther off than allowed",
          "[unit]") {
    Mesh ball = icosphere(10.0, 3);
    for (glm::vec3& position : ball.positions)
        position.x += 4.0f;
    AreaPainting painting(ball);
    painting.dab(nearest_site(ball, {13.0, -5.0, 2.0}), 4.0, 1);
    painting.dab(nearest_site(ball, {4.0, 0.0, 10.0}), 1e-6, 5);
    const auto before = count_of(painting, 1);
    REQUIRE(before > 20);
    AreaPainting elsewhere = AreaPainting(ball, {painting.paints().begin(), painting.paints().end()});
    painting.mirror(1, 4.0, 0.2);
    CHECK(count_of(painting, 1) >= 2 * before - 6);
    CHECK(count_of(painting, 1) <= 2 * before + 6);
    CHECK(count_of(painting, 5) == 1);
    for (std::uint32_t t = 0; t < ball.triangles.size(); ++t) {
        const glm::dvec3 middle = position_of(ball, {t, glm::dvec3(1.0 / 3.0)});
        if (painting.paints()[t] == 1)
            CHECK(glm::distance(glm::dvec3(4.0 + std::abs(middle.x - 4.0), middle.y, middle.z),
                                position_of(ball, nearest_site(ball, {13.0, -5.0, 2.0}))) < 5.0);
    }
    // About a plane through nothing of it there is nothing on the other side.
    elsewhere.mirror(1, 40.0, 0.2);
    CHECK(count_of(elsewhere, 1) == before);
}
