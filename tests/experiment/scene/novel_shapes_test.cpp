#include "experiment/scene/sculptures/novel_shapes.h"

#include <array>
#include <cmath>
#include <set>

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "experiment/scene/mesh_topology.h"

using namespace overt;

namespace {

double area_of_triangle(const Mesh& mesh, std::size_t triangle) {
    const glm::uvec3 t = mesh.triangles[triangle];
    const glm::dvec3 a = mesh.positions[t.x];
    return 0.5 *
           glm::length(glm::cross(glm::dvec3(mesh.positions[t.y]) - a, glm::dvec3(mesh.positions[t.z]) - a));
}

} // namespace

TEST_CASE("each novel shape is closed, in one piece, has its four parts and is like no other", "[unit]") {
    constexpr double coarse_mm = 6.0;
    std::set<std::size_t> sizes;
    for (int number = 1; number <= novel_shape_count; ++number) {
        CAPTURE(number);
        const Mesh mesh = make_novel_shape(number, coarse_mm);
        CHECK(count_edges(mesh.triangles, mesh.positions.size()).bounds_volume());
        CHECK(count_components(mesh.triangles, mesh.positions.size()) == 1);
        CHECK(signed_volume(mesh) > 1e5);
        const Bounds bounds = mesh.bounds();
        CHECK(bounds.min.z == 0.0);
        CHECK(std::abs(bounds.centre().x) < 0.01);
        CHECK(bounds.extent().x > 120.0);
        CHECK(bounds.extent().x < 400.0);
        std::array<double, 4> area{};
        double all = 0.0;
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
            area[mesh.triangle_parts[i]] += area_of_triangle(mesh, i);
            all += area_of_triangle(mesh, i);
        }
        for (const double part : area)
            CHECK(part > 0.04 * all);
        sizes.insert(mesh.triangles.size());
    }
    CHECK(sizes.size() > 20);
    // By its number, whatever the threads; and by no other name.
    CHECK(make_novel_shape(5, coarse_mm, 1).positions == make_novel_shape(5, coarse_mm, 3).positions);
    CHECK(novel_shape_number("shape-05") == 5);
    CHECK_FALSE(novel_shape_number("shape-25"));
    CHECK_FALSE(novel_shape_number("muse"));
    CHECK_THROWS_AS(make_novel_shape(25), InputError);
}
