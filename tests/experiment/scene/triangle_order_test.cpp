#include "experiment/scene/triangle_order.h"

#include <algorithm>
#include <array>
#include <map>

#include <catch2/catch.hpp>
#include <meshoptimizer.h>

#include "experiment/base/random.h"
#include "tests/experiment/scene/mesh_fixtures.h"
#include "tests/support/figures.h"

using namespace overt;

namespace {

/// The places of a triangle's corners, the lowest first, so that a triangle is itself however it is turned,
/// but not if it is turned over.
using Places = std::array<std::array<float, 3>, 3>;

Places places_of(const Mesh& mesh, const glm::uvec3& triangle) {
    Places places{};
    for (int corner = 0; corner < 3; ++corner) {
        const glm::vec3 position = mesh.positions[triangle[corner]];
        places[static_cast<std::size_t>(corner)] = {position.x, position.y, position.z};
    }
    std::rotate(places.begin(), std::min_element(places.begin(), places.end()), places.end());
    return places;
}

/// A ball whose triangles and corners lie in any order, with a part for each of its eighths and a vertex that
/// no triangle has.
Mesh shuffled_ball() {
    Mesh mesh = test::ball({0.0, 0.0, 0.0}, 10.0, 12, 24);
    RandomStream random(3, "order");
    random.shuffle(std::span(mesh.triangles));
    for (glm::uvec3& triangle : mesh.triangles)
        for (std::size_t turn = random.below(3); turn > 0; --turn)
            triangle = {triangle.y, triangle.z, triangle.x};
    mesh.positions.emplace_back(100.0f, 0.0f, 0.0f);
    mesh.part_names.clear();
    for (int part = 0; part < 8; ++part)
        mesh.part_names.push_back(std::string("eighth ") + std::to_string(part));
    mesh.triangle_parts.clear();
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::vec3 middle = mesh.positions[t.x] + mesh.positions[t.y] + mesh.positions[t.z];
        mesh.triangle_parts.push_back(
            static_cast<PartIndex>((middle.x > 0 ? 1 : 0) + (middle.y > 0 ? 2 : 0) + (middle.z > 0 ? 4 : 0)));
    }
    return mesh;
}

/// Vertices that a card with room for sixteen has to work out, for each triangle.
double misses_of(const Mesh& mesh) {
    return static_cast<double>(meshopt_analyzeVertexCache(&mesh.triangles.front().x,
                                                          3 * mesh.triangles.size(), mesh.positions.size(),
                                                          16, 0, 0)
                                   .acmr);
}

} // namespace

TEST_CASE("triangles put in order are the same surface with the same parts, and each knows where it was",
          "[unit]") {
    const Mesh before = shuffled_ball();
    Mesh after = before;
    std::vector<CornersFrom> from;
    order_for_drawing(after, &from);

    std::map<Places, PartIndex> part_of;
    for (std::size_t i = 0; i < before.triangles.size(); ++i)
        part_of[places_of(before, before.triangles[i])] = before.triangle_parts[i];
    REQUIRE(part_of.size() == before.triangles.size());
    REQUIRE(after.triangles.size() == before.triangles.size());
    REQUIRE(after.triangle_parts.size() == before.triangles.size());
    REQUIRE(from.size() == before.triangles.size());
    CHECK(after.part_names == before.part_names);
    std::vector<bool> is_taken(before.triangles.size());
    for (std::size_t i = 0; i < after.triangles.size(); ++i) {
        const auto found = part_of.find(places_of(after, after.triangles[i]));
        REQUIRE(found != part_of.end());
        CHECK(after.triangle_parts[i] == found->second);
        REQUIRE(from[i].triangle < before.triangles.size());
        CHECK_FALSE(is_taken[from[i].triangle]);
        is_taken[from[i].triangle] = true;
        for (int corner = 0; corner < 3; ++corner)
            CHECK(after.positions[after.triangles[i][corner]] ==
                  before.positions[before.triangles[from[i].triangle]
                                                   [from[i].corner[static_cast<std::size_t>(corner)]]]);
    }
    Mesh again = before;
    order_for_drawing(again);
    CHECK(again.triangles == after.triangles);
    CHECK(again.positions == after.positions);
    CHECK(again.triangle_parts == after.triangle_parts);
}

TEST_CASE(
    "triangles put in order are drawn from few vertices at a time, which come in the order of their use",
    "[unit]") {
    const Mesh before = shuffled_ball();
    Mesh after = before;
    order_for_drawing(after);
    CHECK(misses_of(before) > 1.5);
    CHECK(misses_of(after) < 0.85);
    unsigned next = 0;
    for (const glm::uvec3& triangle : after.triangles)
        for (int corner = 0; corner < 3; ++corner) {
            CHECK(triangle[corner] <= next);
            next = std::max(next, triangle[corner] + 1);
        }
    CHECK(next == after.positions.size());
    CHECK(after.positions.size() + 1 == before.positions.size()); // what no triangle has is gone
    Mesh nothing;
    std::vector<CornersFrom> from(7);
    order_for_drawing(nothing, &from);
    CHECK(from.empty());
}
