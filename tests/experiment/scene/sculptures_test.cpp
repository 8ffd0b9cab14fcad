#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <string>

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "experiment/scene/mesh_topology.h"
#include "experiment/scene/sculptures/contouring.h"
#include "experiment/scene/sculptures/figures.h"
#include "experiment/scene/sculptures/sculptures.h"
#include "tests/support/figures.h"

using namespace overt;

namespace {

/// The coarse meshes, made once.
const Mesh& coarse(std::string_view name) {
    static std::map<std::string_view, Mesh> meshes;
    const auto [entry, is_new] = meshes.try_emplace(name);
    if (is_new)
        entry->second = make_sculpture(name, coarse_cell_share);
    return entry->second;
}

double area_of(const Mesh& mesh, std::size_t triangle) {
    const glm::uvec3 t = mesh.triangles[triangle];
    const glm::dvec3 a = mesh.positions[t.x];
    return 0.5 *
           glm::length(glm::cross(glm::dvec3(mesh.positions[t.y]) - a, glm::dvec3(mesh.positions[t.z]) - a));
}

/// Area-weighted middle of a part, and its share of the whole area.
struct PartMiddle {
    glm::dvec3 middle{0.0};
    double share = 0.0;
};

PartMiddle part_middle(const Mesh& mesh, PartIndex part) {
    PartMiddle result;
    double all = 0.0;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const double area = area_of(mesh, i);
        all += area;
        if (mesh.triangle_parts[i] != part)
            continue;
        result.middle += area * test::centroid(mesh, i);
        result.share += area;
    }
    result.middle /= result.share;
    result.share /= all;
    return result;
}

Mesh mesh_of(const ClosedSurface& surface) {
    Mesh mesh;
    mesh.positions.assign(surface.positions.begin(), surface.positions.end());
    mesh.triangles = surface.triangles;
    return mesh;
}

ContourRequest ball_request(double radius_mm, double cell_mm) {
    ContourRequest request;
    request.distance = [radius_mm](const glm::dvec3& p) { return glm::length(p) - radius_mm; };
    request.box_mm = {glm::dvec3(-radius_mm - cell_mm), glm::dvec3(radius_mm + cell_mm)};
    request.cell_mm = cell_mm;
    return request;
}

constexpr std::array<std::string_view, 3> names{"muse", "runner", "scholar"};

} // namespace

TEST_CASE("a contoured ball has its volume to within the square of the cell size", "[unit]") {
    const double exact = 4.0 / 3.0 * M_PI * 27000.0;
    const double error_4 = 1.0 - signed_volume(mesh_of(contour(ball_request(30.0, 4.0)))) / exact;
    const double error_2 = 1.0 - signed_volume(mesh_of(contour(ball_request(30.0, 2.0)))) / exact;
    CHECK(error_4 < 0.01);
    CHECK(error_2 / error_4 == Approx(0.25).margin(0.05));
}

TEST_CASE("a fovea makes the mesh finer within it and leaves it closed and on the surface", "[unit]") {
    ContourRequest request = ball_request(30.0, 3.0);
    const std::size_t even = contour(request).triangles.size();
    request.fovea = {{{0.0, 0.0, 30.0}, 10.0}, 0.4};
    const ClosedSurface surface = contour(request);
    CHECK(surface.triangles.size() > even + 500);
    CHECK(count_edges(surface.triangles, surface.positions.size()).bounds_volume());
    double farthest = 0.0;
    std::array<std::size_t, 2> near_pole{};
    for (const glm::dvec3& position : surface.positions) {
        farthest = std::max(farthest, std::abs(request.distance(position)));
        if (std::abs(position.z) > 25.0)
            ++near_pole[position.z > 0.0];
    }
    CHECK(farthest < 1e-3);
    CHECK(near_pole[1] > 2 * near_pole[0]);
}

TEST_CASE("a surface that the grid cannot resolve still bounds a volume", "[unit]") {
    // Sheets closer together than the cells: faces and cells with every pattern of inside corners occur.
    ContourRequest request = ball_request(40.0, 3.0);
    request.distance = [](const glm::dvec3& p) {
        const double sponge = std::sin(1.31 * p.x) * std::cos(1.17 * p.y) +
                              std::sin(1.43 * p.y) * std::cos(1.09 * p.z) +
                              std::sin(1.23 * p.z) * std::cos(1.37 * p.x);
        return std::max(glm::length(p) - 40.0, 0.6 * sponge - 0.1);
    };
    const ClosedSurface surface = contour(request);
    CHECK(surface.triangles.size() > 5000);
    CHECK(count_edges(surface.triangles, surface.positions.size()).bounds_volume());
    CHECK(count_components(surface.triangles, surface.positions.size()) == 1);
}

TEST_CASE("contouring where there is no surface is refused", "[unit]") {
    ContourRequest request = ball_request(30.0, 4.0);
    request.distance = [](const glm::dvec3&) { return 1.0; };
    CHECK_THROWS_AS(contour(request), InputError);
}

TEST_CASE("each sculpture is closed, manifold, outward, in one piece and without degenerate triangles",
          "[unit]") {
    for (const std::string_view name : names) {
        INFO(name);
        const Mesh& mesh = coarse(name);
        const EdgeCounts edges = count_edges(mesh.triangles, mesh.positions.size());
        CHECK(edges.bounds_volume());
        CHECK(count_components(mesh.triangles, mesh.positions.size()) == 1);
        const auto euler = static_cast<long>(mesh.positions.size()) - static_cast<long>(edges.edges) +
                           static_cast<long>(mesh.triangles.size());
        CHECK(euler <= 2);
        CHECK(euler % 2 == 0);
        CHECK(signed_volume(mesh) > 1e6);
        double least = 1e30;
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
            least = std::min(least, area_of(mesh, i));
        CHECK(least > 0.0);
        CHECK(mesh.triangles.size() < 10000);
    }
}

TEST_CASE("each sculpture stands on z = 0, about 600 mm high, centred on its axis", "[unit]") {
    for (const std::string_view name : names) {
        INFO(name);
        const Bounds bounds = coarse(name).bounds();
        CHECK(bounds.min.z == 0.0);
        CHECK(bounds.max.z == Approx(600.0).margin(15.0));
        CHECK(bounds.centre().x == Approx(0.0).margin(1e-3));
        CHECK(bounds.centre().y == Approx(0.0).margin(1e-3));
    }
}

TEST_CASE("a sculpture has the same bits on one thread and on many", "[unit]") {
    const Mesh one = make_sculpture("runner", coarse_cell_share, 1);
    const Mesh& many = coarse("runner");
    REQUIRE(one.positions.size() == many.positions.size());
    CHECK(std::memcmp(one.positions.data(), many.positions.data(),
                      one.positions.size() * sizeof(glm::vec3)) == 0);
    CHECK(one.triangles == many.triangles);
    CHECK(one.triangle_parts == many.triangle_parts);
}

TEST_CASE("every triangle of a head is above every triangle of the plinth, with the body between", "[unit]") {
    for (const std::string_view name : names) {
        INFO(name);
        const Mesh& mesh = coarse(name);
        REQUIRE(mesh.part_names == std::vector<std::string>{"head", "body", "plinth"});
        REQUIRE(mesh.triangle_parts.size() == mesh.triangles.size());
        double lowest_of_head = 1e30;
        double highest_of_plinth = 0.0;
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
            if (mesh.triangle_parts[i] == 0)
                lowest_of_head = std::min(lowest_of_head, test::centroid(mesh, i).z);
            if (mesh.triangle_parts[i] == 2)
                highest_of_plinth = std::max(highest_of_plinth, test::centroid(mesh, i).z);
        }
        CHECK(lowest_of_head > highest_of_plinth + 150.0);
        CHECK(part_middle(mesh, 0).share > 0.03);
        CHECK(part_middle(mesh, 0).share < 0.12);
        CHECK(part_middle(mesh, 1).share > 0.4);
        CHECK(part_middle(mesh, 2).share > 0.1);
    }
}

TEST_CASE("the runner's head is far off the axis of rotation, the others' heads are near it", "[unit]") {
    const auto off_axis = [](std::string_view name) {
        const glm::dvec3 middle = part_middle(coarse(name), 0).middle;
        return std::hypot(middle.x, middle.y);
    };
    CHECK(off_axis("runner") > 80.0);
    CHECK(off_axis("muse") < 30.0);
    CHECK(off_axis("scholar") < 30.0);
}

TEST_CASE("the vertices of a sculpture lie on the modelled surface", "[unit]") {
    const Figure figure = model_muse();
    const Clay whole = figure.whole();
    ContourRequest request;
    request.distance = [&](const glm::dvec3& p) { return whole.distance(p); };
    request.box_mm = figure.box_mm;
    request.cell_mm = 8.0;
    request.fovea = figure.fovea;
    const ClosedSurface surface = contour(request);
    std::size_t off = 0;
    for (const glm::dvec3& position : surface.positions)
        off += std::abs(whole.distance(position)) > 0.05;
    // Where two folds meet in a crease narrower than a cell, Newton steps may not settle.
    CHECK(static_cast<double>(off) < 0.02 * static_cast<double>(surface.positions.size()));
}

TEST_CASE("an unknown sculpture is refused with the names of those that are shipped", "[unit]") {
    for (const SculptureDescription& sculpture : shipped_sculptures())
        CHECK_THROWS_WITH(make_sculpture("hermes"), Catch::Contains(std::string(sculpture.name)));
    CHECK_THROWS_AS(make_sculpture("hermes"), InputError);
    CHECK_THROWS_AS(make_sculpture("muse", 0.2), InputError);
}
