#include "experiment/scene/making/flat_mesh.h"

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "experiment/scene/areas.h"

using namespace overt;

TEST_CASE("a flat mesh is the whole rectangle, its front to the observer, in pieces finer than a kernel",
          "[unit]") {
    const Mesh mesh = make_flat_mesh({90.0, 60.0}, {});
    CHECK(mesh.area() == Approx(5400.0));
    CHECK(mesh.part_names == std::vector<std::string>{std::string(rest_part)});
    CHECK(mesh.bounds().min == glm::dvec3(0.0));
    CHECK(mesh.bounds().max.x == Approx(90.0));
    CHECK(mesh.bounds().max.y == 0.0);
    CHECK(mesh.bounds().max.z == Approx(60.0));
    double longest = 0.0;
    for (const glm::uvec3& triangle : mesh.triangles) {
        const glm::dvec3 a(mesh.positions[triangle.x]), b(mesh.positions[triangle.y]),
            c(mesh.positions[triangle.z]);
        const glm::dvec3 normal = glm::cross(b - a, c - a);
        CHECK(normal.y < 0.0);
        CHECK(std::abs(normal.x) + std::abs(normal.z) == 0.0);
        longest = std::max({longest, glm::length(b - a), glm::length(c - b), glm::length(a - c)});
    }
    CHECK(longest < 1.5 * 90.0 / flat_cells * std::sqrt(2.0));
    CHECK_THROWS_AS(make_flat_mesh({90.0, 0.0}, {}), InputError);
}

TEST_CASE("a box on a flat mesh is cut at its own edges, wherever they lie; a disc by its cells", "[unit]") {
    // Edges between lines of the grid, one beyond the rectangle, and two that nearly meet.
    const std::vector<PartRegion> regions{
        {"box", {}, {}, {{{glm::dvec3(10.13, -1, 20.71), glm::dvec3(33.37, 1, 41.19)}}}},
        {"edge", {}, {}, {{{glm::dvec3(80.0, -1, -5.0), glm::dvec3(120.0, 1, 5.000001)}}}},
        {"near", {}, {}, {{{glm::dvec3(50.0, -1, 5.0), glm::dvec3(60.0, 1, 9.0)}}}},
        {"disc", {glm::dvec4(60.0, 0.0, 40.0, 12.0)}, {}, {}}};
    const Mesh mesh = make_flat_mesh({90.0, 60.0}, regions);
    CHECK(mesh.area() == Approx(5400.0));
    const std::vector<double> areas = mesh.part_areas();
    const auto area_of = [&](std::string_view name) {
        double sum = 0.0;
        for (std::size_t part = 0; part < areas.size(); ++part)
            if (part_is_in_area(mesh.part_names[part], name))
                sum += areas[part];
        return sum;
    };
    CHECK(area_of("box") == Approx((33.37 - 10.13) * (41.19 - 20.71)).epsilon(1e-5));
    CHECK(area_of("edge") == Approx(10.0 * 5.0).epsilon(1e-5));
    CHECK(area_of("near") == Approx(10.0 * 4.0).epsilon(1e-5));
    CHECK(area_of("disc") == Approx(3.14159265 * 144.0).epsilon(0.01));
}
