#include <catch2/catch.hpp>

#include "experiment/surface/surface_geometry.h"
#include "tests/experiment/surface/flat_and_round.h"
#include "tests/support/figures.h"

using namespace overt;
using namespace overt::test;

TEST_CASE("the areas of vertices sum to the area of the surface, in millimetres", "[unit]") {
    const Mesh mesh = flat_square(0.5, 10);
    const SurfaceGeometry geometry(mesh, 20.0);
    CHECK(geometry.total_area_mm2() == Approx(400.0));
    const std::vector<double> areas = geometry.vertex_areas_mm2();
    CHECK(std::accumulate(areas.begin(), areas.end(), 0.0) == Approx(400.0));
    // An inner vertex of this mesh has six triangles of half a square: 4 mm^2 in all, of which a third is 4.
    CHECK(areas[5 * 11 + 5] == Approx(4.0));
    CHECK(pieces_of(geometry).count == 1);
}

TEST_CASE("a seam of duplicate vertices does not cut a surface", "[unit]") {
    const Mesh mesh = flat_square(1.0, 4), loose = with_loose_triangles(mesh);
    const SurfaceGeometry whole(mesh), pieces(loose);
    CHECK(pieces.node_count() == whole.node_count());
    CHECK(pieces_of(pieces).count == 1);
    CHECK(pieces.total_area_mm2() == Approx(whole.total_area_mm2()));
    const std::vector<double> areas = pieces.vertex_areas_mm2();
    CHECK(areas.size() == loose.positions.size());
    CHECK(std::accumulate(areas.begin(), areas.end(), 0.0) == Approx(4.0));
}

TEST_CASE("triangles that are no surface do not count, and triangles without area hold theirs together",
          "[unit]") {
    Mesh mesh = flat_square(1.0, 2);
    const double area = SurfaceGeometry(mesh).total_area_mm2();
    mesh.triangles.push_back(mesh.triangles.front());                                           // twice
    mesh.triangles.emplace_back(mesh.triangles[3].y, mesh.triangles[3].z, mesh.triangles[3].x); // turned
    mesh.triangles.emplace_back(4, 4, 1);                                                       // an edge
    CHECK(SurfaceGeometry(mesh).total_area_mm2() == Approx(area));

    // Two squares that only meet along an edge of which one has an additional vertex in the middle.
    Mesh joint;
    joint.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 1, 0}, {0.5, 2, 0}};
    joint.triangles = {{0, 1, 2}, {0, 2, 3}, {3, 4, 5}, {4, 2, 5}, {3, 2, 4}};
    const SurfaceGeometry geometry(joint);
    CHECK(pieces_of(geometry).count == 1);
    for (const auto& [a, b, weight] : geometry.triangulation().edge_weights())
        CHECK(std::isfinite(weight));
}

TEST_CASE("pieces that do not hang together are told apart, and lone vertices are pieces", "[unit]") {
    Mesh mesh = flat_square(1.0, 3);
    test::add_part(mesh, flat_square(1.0, 3, 0.5), "lid");
    mesh.positions.emplace_back(7.0f, 7.0f, 7.0f);
    const SurfaceGeometry geometry(mesh);
    const Pieces pieces = pieces_of(geometry);
    CHECK(pieces.count == 3);
    CHECK(pieces.of_node[0] == pieces.of_node[15]);
    CHECK(pieces.of_node[0] != pieces.of_node[16]);
    CHECK(geometry.vertex_areas_mm2().back() == 0.0);
}

TEST_CASE("exchanged edges leave area and lengths, and no weight is negative", "[unit]") {
    // Rows shifted by 1.7 squares: all triangles are obtuse, and several exchanges follow one another.
    const Mesh mesh = flat_square(1.0, 12, 0.0, 1.7);
    const SurfaceGeometry geometry(mesh);
    const IntrinsicTriangulation& triangulation = geometry.triangulation();
    CHECK(triangulation.exchanged() > 100);
    double area = 0.0;
    for (const IntrinsicTriangulation::Triangle& t : triangulation.triangles()) {
        const double a = t.lengths_mm[0], b = t.lengths_mm[1], c = t.lengths_mm[2];
        area += 0.25 * std::sqrt((a + b + c) * (b + c - a) * (c + a - b) * (a + b - c));
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::dvec3 from = geometry.node_positions_mm()[t.nodes[k]];
            const glm::dvec3 to = geometry.node_positions_mm()[t.nodes[(k + 1) % 3]];
            // On a plane an edge laid through triangles is the straight one.
            REQUIRE(t.lengths_mm[k] == Approx(glm::distance(from, to)).epsilon(1e-6));
        }
    }
    CHECK(area == Approx(geometry.total_area_mm2()).epsilon(1e-6));
    for (const auto& [a, b, weight] : triangulation.edge_weights())
        REQUIRE(weight > 0.0);
}
