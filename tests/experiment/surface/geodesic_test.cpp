#include <catch2/catch.hpp>

#include "experiment/surface/geodesic_field.h"
#include "tests/experiment/surface/flat_and_round.h"
#include "tests/support/figures.h"

using namespace overt;
using namespace overt::test;

namespace {

struct DistanceError {
    double mean = 0.0, most = 0.0; ///< of the distance
};

/// Of nodes farther than `from_mm`.
template <class Expected>
DistanceError error_of(GeodesicField& field, const Expected& expected, double from_mm) {
    DistanceError error;
    double count = 0.0;
    for (const std::uint32_t node : field.reached()) {
        const double wanted = expected(field.geometry().node_positions_mm()[node]);
        if (wanted < from_mm)
            continue;
        const double share = std::abs(field.to_node(node) - wanted) / wanted;
        error.most = std::max(error.most, share);
        error.mean += share;
        count += 1.0;
    }
    error.mean /= count;
    return error;
}

} // namespace

TEST_CASE("distances on a plane are the straight ones", "[unit]") {
    // With rows shifted by 1.7 squares the mesh's edges are up to 4 mm long, and few of them are kept.
    for (const auto& [skew, from_mm, mean, most] :
         {std::tuple(0.0, 1.0, 0.001, 0.02), std::tuple(0.4, 1.0, 0.001, 0.02),
          std::tuple(1.7, 8.0, 0.015, 0.1)}) {
        const Mesh mesh = flat_square(30.0, 40, 0.0, skew);
        const SurfaceGeometry geometry(mesh);
        GeodesicField field(geometry);
        const SurfacePlace source{40 * 40 + 41, {0.2, 0.5, 0.3}};
        const glm::dvec3 place = geometry.position_mm(source);
        field.spread_from(source, 25.0);
        const DistanceError error = error_of(
            field, [&](const glm::dvec3& at) { return glm::distance(at, place); }, from_mm);
        CAPTURE(skew, error.mean, error.most);
        CHECK(error.mean < mean);
        CHECK(error.most < most);
        for (const std::uint32_t node : field.reached())
            REQUIRE(field.to_node(node) < 25.0);
    }
}

TEST_CASE("distances on a sphere are arcs of great circles", "[unit]") {
    const Mesh mesh = icosphere(50.0, 5);
    const SurfaceGeometry geometry(mesh);
    GeodesicField field(geometry);
    for (const std::uint32_t triangle : {0u, 5000u, 12345u}) {
        const SurfacePlace source{triangle, {0.3, 0.3, 0.4}};
        const glm::dvec3 place = geometry.position_mm(source);
        field.spread_from(source);
        CHECK(field.reached().size() == geometry.node_count());
        const DistanceError error = error_of(
            field,
            [&](const glm::dvec3& at) {
                return 50.0 *
                       std::acos(std::clamp(glm::dot(glm::normalize(at), glm::normalize(place)), -1.0, 1.0));
            },
            5.0);
        CAPTURE(error.mean, error.most);
        CHECK(error.mean < 0.003);
        CHECK(error.most < 0.01);
    }
}

TEST_CASE("distances between places are the same there and back, and to the place itself nothing", "[unit]") {
    const Mesh mesh = icosphere(50.0, 4);
    const SurfaceGeometry geometry(mesh);
    GeodesicField field(geometry);
    for (std::uint32_t i = 0; i < 20; ++i) {
        const SurfacePlace a{i * 251 % 5120, {0.6, 0.3, 0.1}}, b{(i * 877 + 1300) % 5120, {0.2, 0.1, 0.7}};
        field.spread_from(a);
        const double there = field.to(b);
        CHECK(field.to(a) == 0.0);
        field.spread_from(b);
        CHECK(field.to(a) == Approx(there).epsilon(0.005));
    }
}

TEST_CASE("there is no way to another piece of the surface", "[unit]") {
    Mesh mesh = flat_square(10.0, 10);
    add_part(mesh, flat_square(10.0, 10, 0.5), "lid");
    const SurfaceGeometry geometry(mesh);
    GeodesicField field(geometry);
    field.spread_from({0, {1, 0, 0}});
    CHECK(field.to({399, {1, 0, 0}}) == GeodesicField::unreached);
    CHECK(field.to({199, {1, 0, 0}}) < 30.0);
}

TEST_CASE("the geodesic median of a patch is the one in space", "[unit]") {
    const Mesh mesh = flat_square(20.0, 40);
    const SurfaceGeometry geometry(mesh);
    GeodesicField field(geometry);
    std::vector<SurfaceWeight> weights;
    for (std::uint32_t i = 0; i < 9; ++i)
        weights.push_back({{2 * (20 * 40 + 4 + 3 * i), {0.4, 0.3, 0.3}}, 1.0, 0.0});
    // Places in a row: the median is the middle one, however far away the last is.
    weights.push_back({{40, {1, 0, 0}}, 0.5, 0.0});
    const GeodesicMedian median = geodesic_median(field, weights);
    CHECK(median.index == 4);
    CHECK(median.unreached_share == 0.0);
}

TEST_CASE("the geodesic median lies where most of the gaze was, not between two sheets", "[unit]") {
    // A strip folded into a hairpin: two sheets 2 mm apart, 80 mm along the surface.
    Mesh mesh = flat_square(40.0, 40);
    for (glm::vec3& position : mesh.positions) {
        if (position.x > 0.0f)
            position = {-position.x, position.y, 2.0f};
    }
    const SurfaceGeometry geometry(mesh);
    GeodesicField field(geometry);
    const auto at_column = [](std::uint32_t column, std::uint32_t row) {
        return SurfacePlace{2 * (row * 40 + column), {0.4, 0.3, 0.3}};
    };
    std::vector<SurfaceWeight> weights;
    for (std::uint32_t i = 0; i < 7; ++i)
        weights.push_back({at_column(3, 17 + i), 1.0, 0.0});
    for (std::uint32_t i = 0; i < 12; ++i)
        weights.push_back({at_column(36, 14 + i), 1.0, 0.0});
    const GeodesicMedian median = geodesic_median(field, weights);
    CHECK(median.index >= 7);
    // The others are 66 mm away along the surface, 2 mm through the air.
    CHECK(median.mean_distance_mm > 7.0 / 19.0 * 65.0);
}
