#include "experiment/scene/making/mesh_cleaning.h"

#include <algorithm>
#include <limits>
#include <random>

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "experiment/scene/making/vertex_welder.h"
#include "experiment/scene/mesh_topology.h"
#include "tests/experiment/scene/mesh_fixtures.h"

using namespace overt;
using namespace overt::test;

namespace {

// Every triangle with three vertices of its own.
Mesh as_soup(const Mesh& mesh) {
    Mesh soup;
    soup.positions = corners_of(mesh);
    for (std::uint32_t i = 0; i < soup.positions.size(); i += 3)
        soup.triangles.emplace_back(i, i + 1, i + 2);
    return with_one_part(std::move(soup));
}

void add_triangle(Mesh& mesh, glm::uvec3 triangle, PartIndex part = 0) {
    mesh.triangles.push_back(triangle);
    mesh.triangle_parts.push_back(part);
}

bool same(const Mesh& a, const Mesh& b) {
    return a.positions == b.positions && a.triangles == b.triangles && a.triangle_parts == b.triangle_parts;
}

} // namespace

TEST_CASE("a closed mesh has 3/2 edges for each triangle, all with two triangles", "[unit]") {
    for (const Mesh& mesh : {cube(), bumpy_ball()}) {
        const EdgeCounts counts = count_edges(mesh.triangles, mesh.positions.size());
        CHECK(2 * counts.edges == 3 * mesh.triangles.size());
        CHECK(counts.bounds_volume());
        // Euler: vertices - edges + faces = 2 for a surface without handles.
        CHECK(mesh.positions.size() + mesh.triangles.size() == counts.edges + 2);
        CHECK(count_components(mesh.triangles, mesh.positions.size()) == 1);
    }
}

TEST_CASE("edges with one, with more than two and with disagreeing triangles are told apart", "[unit]") {
    Mesh mesh = cube();
    mesh.triangles.pop_back();
    EdgeCounts counts = count_edges(mesh.triangles, 8);
    CHECK(counts.boundary == 3);
    CHECK_FALSE(counts.is_closed());

    mesh = cube();
    std::swap(mesh.triangles[4].x, mesh.triangles[4].y);
    counts = count_edges(mesh.triangles, 8);
    CHECK(counts.conflicting == 3);
    CHECK(counts.is_closed());
    CHECK_FALSE(counts.bounds_volume());

    mesh = cube();
    mesh.triangles.emplace_back(0, 3,
                                7); // a wall through the inside: along two diagonals and an edge of the cube
    counts = count_edges(mesh.triangles, 8);
    CHECK(counts.non_manifold == 2);
    CHECK(counts.boundary == 1);
}

TEST_CASE("the edges of random triangles are counted as a plain count counts them", "[unit]") {
    std::mt19937 random(5);
    std::vector<glm::uvec3> triangles;
    while (triangles.size() < 300) {
        const glm::uvec3 t(random() % 20, random() % 20, random() % 20);
        if (t.x != t.y && t.y != t.z && t.z != t.x)
            triangles.push_back(t);
    }
    EdgeCounts plain;
    for (std::uint32_t a = 0; a < 20; ++a) {
        for (std::uint32_t b = a + 1; b < 20; ++b) {
            int upwards = 0, downwards = 0;
            for (const glm::uvec3& t : triangles) {
                for (int i = 0; i < 3; ++i) {
                    upwards += t[i] == a && t[(i + 1) % 3] == b;
                    downwards += t[i] == b && t[(i + 1) % 3] == a;
                }
            }
            const int uses = upwards + downwards;
            plain.edges += uses > 0;
            plain.boundary += uses == 1;
            plain.non_manifold += uses > 2;
            plain.conflicting += uses == 2 && upwards != 1;
        }
    }
    REQUIRE(plain.conflicting > 0);
    const EdgeCounts counts = count_edges(triangles, 20);
    CHECK(counts.edges == plain.edges);
    CHECK(counts.boundary == plain.boundary);
    CHECK(counts.non_manifold == plain.non_manifold);
    CHECK(counts.conflicting == plain.conflicting);
}

TEST_CASE("pieces without a common vertex are counted, unused vertices are not", "[unit]") {
    const std::vector<glm::uvec3> triangles{{0, 1, 2}, {5, 4, 3}, {2, 6, 7}, {9, 10, 11}};
    CHECK(count_components(triangles, 20) == 3);
    CHECK(count_components({}, 20) == 0);
}

TEST_CASE("the signed volume of a cube is 1 wherever it stands, and -1 inside out", "[unit]") {
    Mesh mesh = cube();
    for (glm::vec3& position : mesh.positions)
        position += glm::vec3(100.0f, -50.0f, 3.0f);
    CHECK(signed_volume(mesh) == Approx(1.0));
    for (glm::uvec3& triangle : mesh.triangles)
        std::swap(triangle.x, triangle.y);
    CHECK(signed_volume(mesh) == Approx(-1.0));
}

TEST_CASE("a soup of triangles is welded to the mesh it was made from", "[unit]") {
    for (const Mesh& original : {cube(), bumpy_ball()}) {
        Mesh mesh = as_soup(original);
        const MeshCleaningReport report = clean_mesh(mesh);
        CHECK(mesh.positions.size() == original.positions.size());
        CHECK(corners_of(mesh) == corners_of(original));
        CHECK(report.vertices_read == 3 * original.triangles.size());
        CHECK(report.vertices_welded == report.vertices_read - original.positions.size());
        CHECK(report.boundary_edges == 0);
        CHECK(report.components == 1);
    }
}

TEST_CASE("a clean mesh stays as it is, and nothing is said of it", "[unit]") {
    Mesh mesh = bumpy_ball();
    const MeshCleaningReport report = clean_mesh(mesh);
    CHECK(same(mesh, bumpy_ball()));
    CHECK(describe(report).empty());
}

TEST_CASE("faces without area, repeated faces and unused vertices go; the rest keeps order and parts",
          "[unit]") {
    Mesh mesh = cube();
    for (std::size_t i = 0; i < 12; ++i)
        mesh.triangle_parts[i] = static_cast<PartIndex>(i);
    const Mesh original = mesh;
    mesh.positions.emplace_back(0.5f, 0.0f, 0.0f);  // 8: on an edge, used by a face without area only
    mesh.positions.emplace_back(7.0f, 7.0f, 7.0f);  // 9: used by nothing
    mesh.positions.emplace_back(0.0f, -0.0f, 0.0f); // 10: the same place as 0
    mesh.triangles.insert(mesh.triangles.begin(), {{0, 8, 1}, {3, 3, 5}, {10, 0, 7}});
    mesh.triangle_parts.insert(mesh.triangle_parts.begin(), {20, 21, 22});
    add_triangle(mesh, {3, 10, 2}, 23); // the first face of the cube once more
    const MeshCleaningReport report = clean_mesh(mesh);
    CHECK(same(mesh, original));
    CHECK(report.triangles_read == 16);
    CHECK(report.vertices_welded == 1);
    CHECK(report.degenerate_faces_dropped == 3);
    CHECK(report.duplicate_faces_dropped == 1);
    CHECK(report.unreferenced_vertices_dropped == 2);
    CHECK(describe(report).size() == 4);
}

TEST_CASE("a face and its reverse are two sides and both stay", "[unit]") {
    Mesh mesh = cube();
    add_triangle(mesh, {0, 3, 2});
    const MeshCleaningReport report = clean_mesh(mesh);
    CHECK(mesh.triangles.size() == 13);
    CHECK(report.duplicate_faces_dropped == 0);
    CHECK(report.non_manifold_edges == 3);
}

TEST_CASE("every repeated face goes, also with others between, and the first of each stays", "[unit]") {
    std::mt19937 random(8);
    Mesh mesh = cube();
    while (mesh.triangles.size() < 400) {
        const glm::uvec3 t(random() % 8, random() % 8, random() % 8);
        if (t.x != t.y && t.y != t.z && t.z != t.x)
            add_triangle(mesh, t, PartIndex(mesh.triangles.size() % 256));
    }
    std::vector<glm::uvec3> different;
    std::vector<PartIndex> parts;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const glm::uvec3 t = mesh.triangles[i];
        const bool is_new = std::none_of(different.begin(), different.end(), [&](const glm::uvec3& earlier) {
            return earlier == t || earlier == glm::uvec3(t.y, t.z, t.x) ||
                   earlier == glm::uvec3(t.z, t.x, t.y);
        });
        if (!is_new)
            continue;
        different.push_back(t);
        parts.push_back(mesh.triangle_parts[i]);
    }
    REQUIRE(different.size() < 200);
    const MeshCleaningReport report = clean_mesh(mesh);
    CHECK(mesh.triangles == different);
    CHECK(mesh.triangle_parts == parts);
    CHECK(report.duplicate_faces_dropped == 400 - different.size());
}

TEST_CASE("a closed mesh that is inside out is turned, an open one is only reported", "[unit]") {
    Mesh mesh = cube();
    for (glm::uvec3& triangle : mesh.triangles)
        std::swap(triangle.y, triangle.z);
    Mesh open = mesh;
    MeshCleaningReport report = clean_mesh(mesh);
    CHECK(report.inverted);
    CHECK(report.flipped);
    CHECK(same(mesh, cube()));
    CHECK_THAT(describe(report).back(), Catch::Contains("inside out"));
    report = clean_mesh(mesh);
    CHECK_FALSE(report.inverted);

    open.triangles.pop_back();
    open.triangle_parts.pop_back();
    report = clean_mesh(open);
    CHECK(report.inverted);
    CHECK_FALSE(report.flipped);
    CHECK(signed_volume(open) < 0.0);
    CHECK_THAT(describe(report).back(), Catch::Contains("left so"));
}

TEST_CASE("cleaning a cleaned mesh changes nothing, whatever it was made of", "[unit]") {
    std::mt19937 random(11);
    for (int trial = 0; trial < 30; ++trial) {
        Mesh mesh;
        for (int i = 0; i < 60; ++i)
            mesh.positions.emplace_back(random() % 4, random() % 4, random() % 4);
        for (int i = 0; i < 100; ++i)
            mesh.triangles.emplace_back(random() % 60, random() % 60, random() % 60);
        mesh = with_one_part(std::move(mesh));
        const double tolerance = trial % 2 == 0 ? 0.0 : 1.1;
        const double area = mesh.area();
        clean_mesh(mesh, tolerance);
        CHECK(mesh.area() <= (tolerance > 0.0 ? HUGE_VAL : area * (1 + 1e-12)));
        const Mesh once = mesh;
        const MeshCleaningReport again = clean_mesh(mesh, tolerance);
        CHECK(same(mesh, once));
        CHECK(again.vertices_welded + again.degenerate_faces_dropped + again.duplicate_faces_dropped +
                  again.unreferenced_vertices_dropped ==
              0);
    }
}

TEST_CASE("welding within a tolerance finds the nearest earlier place, as a plain search does", "[unit]") {
    std::mt19937 random(3);
    bool on_lattice = false; // where many places are equally near
    const auto coordinate = [&] {
        const double value = static_cast<double>(random() % 2001) / 100.0 - 10.0;
        return on_lattice ? std::round(value) : value;
    };
    for (const double tolerance : {0.0, 0.05, 1.0, 1.0, 2.5, 2.5, 7.0}) {
        on_lattice = !on_lattice;
        VertexWelder welder(tolerance);
        std::vector<glm::dvec3> places;
        for (int i = 0; i < 3000; ++i) {
            const glm::dvec3 position(coordinate(), coordinate(), coordinate());
            std::size_t nearest = places.size();
            double shortest = std::numeric_limits<double>::infinity();
            for (std::size_t place = 0; place < places.size(); ++place) {
                const glm::dvec3 apart = places[place] - position;
                const double squared = glm::dot(apart, apart);
                if (squared <= tolerance * tolerance && squared < shortest) {
                    nearest = place;
                    shortest = squared;
                }
            }
            if (nearest == places.size())
                places.push_back(position);
            REQUIRE(welder.index_of(position) == nearest);
        }
        CHECK(welder.positions() == places);
    }
}

TEST_CASE("a tolerance that is negative or no number is refused", "[unit]") {
    Mesh mesh = cube();
    for (const double tolerance : {-1.0, std::nan(""), HUGE_VAL}) {
        CHECK_THROWS_AS(clean_mesh(mesh, tolerance), InputError);
    }
}
