#include "experiment/surface/hat_smoother.h"

#include <numeric>

#include <catch2/catch.hpp>

#include "experiment/base/random.h"
#include "experiment/statistics/map_similarity.h"
#include "experiment/surface/surface_smoother.h"
#include "tests/experiment/surface/flat_and_round.h"
#include "tests/support/figures.h"

using namespace overt;
using namespace overt::test;

namespace {

/// Some fixations, most of them in a few clusters.
std::vector<SurfaceWeight> clustered(const SurfaceGeometry& geometry, double sigma_mm, int count) {
    RandomStream random(5, "weights on a surface");
    std::vector<SurfaceWeight> weights;
    for (int i = 0; i < count; ++i) {
        const auto triangle = random.below(static_cast<std::uint32_t>(geometry.triangle_count()));
        weights.push_back({{triangle, {0.2, 0.5, 0.3}}, 1.0 + i % 4, sigma_mm});
    }
    return weights;
}

double total(std::span<const SurfaceWeight> weights) {
    double sum = 0.0;
    for (const SurfaceWeight& weight : weights)
        sum += weight.weight;
    return sum;
}

void compare_with_all_nodes(const Mesh& mesh, double mm_per_unit, double sigma_mm) {
    const SurfaceGeometry geometry(mesh, mm_per_unit);
    const std::vector<SurfaceWeight> weights = clustered(geometry, sigma_mm, 25);
    const std::vector<double> expected = SurfaceSmoother(geometry, sigma_mm).density(weights);
    const std::vector<double> made =
        HatSmoother(geometry, sigma_mm, sigma_mm).densities(std::span(&weights, 1)).front();
    REQUIRE(made.size() == mesh.positions.size());
    CHECK(mass_of(made, geometry) == Approx(total(weights)).epsilon(1e-9));
    CHECK(*std::min_element(made.begin(), made.end()) >= 0.0);
    const double cc = *correlation(made, expected, geometry.vertex_areas_mm2());
    const double shared = *similarity(made, expected, geometry.vertex_areas_mm2(), SimConvention::pysaliency);
    CAPTURE(sigma_mm, cc, shared);
    CHECK(cc >= 0.995);
    CHECK(shared >= 0.97);
}

} // namespace

TEST_CASE("hats a fraction of sigma apart make the map that all nodes make", "[unit]") {
    const Mesh sphere = icosphere(100.0, 6); // 40,962 nodes, about 1.9 mm apart
    for (const double sigma_mm : {12.0, 20.0})
        compare_with_all_nodes(sphere, 1.0, sigma_mm);
    compare_with_all_nodes(icosphere(100.0, 5), 1.0, 45.0); // for the wide a quarter of the nodes does
    // Two sheets 1 mm apart, over which nothing leaps.
    Mesh sheets = flat_square(100.0, 120);
    add_part(sheets, flat_square(100.0, 120, 1.0), "lid");
    compare_with_all_nodes(sheets, 1.0, 15.0);
    compare_with_all_nodes(sheets, 0.1, 1.5);
}

TEST_CASE("hats keep the mass of each piece, and of each piece alone", "[unit]") {
    Mesh sheets = flat_square(100.0, 100);
    add_part(sheets, flat_square(100.0, 100, 1.0), "lid");
    const SurfaceGeometry geometry(sheets);
    const std::vector<SurfaceWeight> below{{{3000, {0.2, 0.5, 0.3}}, 7.0, 20.0}};
    const HatSmoother smoother(geometry, 20.0, 20.0);
    const std::vector<double> made = smoother.densities(std::span(&below, 1)).front();
    const std::size_t half = made.size() / 2;
    CHECK(std::accumulate(made.begin() + static_cast<std::ptrdiff_t>(half), made.end(), 0.0) == 0.0);
    // At some nodes it is the same function, scaled to the areas for which they stand.
    std::vector<std::uint32_t> nodes;
    std::vector<double> areas;
    for (std::uint32_t node = 0; node < geometry.node_count(); node += 3) {
        nodes.push_back(node);
        areas.push_back(3.0 * geometry.node_areas_mm2()[node]);
    }
    const std::vector<double> at_some = smoother.densities_at(std::span(&below, 1), nodes, areas).front();
    REQUIRE(at_some.size() == areas.size());
    double mass = 0.0;
    for (std::size_t i = 0; i < areas.size(); ++i) {
        mass += areas[i] * at_some[i];
        CHECK(at_some[i] == Approx(made[nodes[i]]).epsilon(0.01).margin(1e-12));
    }
    CHECK(mass == Approx(7.0).epsilon(1e-9));
}

TEST_CASE("a map of hats is the same to the bit with others and on any number of threads", "[unit]") {
    const SurfaceGeometry geometry(icosphere(100.0, 5));
    const HatSmoother smoother(geometry, 20.0, 30.0);
    std::vector<std::vector<SurfaceWeight>> maps;
    for (int i = 0; i < 19; ++i)
        maps.push_back(clustered(geometry, 20.0 + i % 3 * 5.0, 1 + i));
    const auto on_one = smoother.densities(maps, 1), on_four = smoother.densities(maps, 4);
    CHECK(on_one == on_four);
    CHECK(smoother.densities(std::span(maps).subspan(7, 1)).front() == on_one[7]);
    CHECK(HatSmoother(geometry, 20.0, 30.0).densities(maps) == on_one);
}

TEST_CASE("hats add up to 1 at every node of a triangle, and sit apart", "[unit]") {
    Mesh mesh = icosphere(100.0, 4);
    mesh.positions.emplace_back(500.0, 0.0, 0.0); // of no triangle
    const SurfaceGeometry geometry(mesh);
    const SurfaceHats hats(geometry, 25.0);
    CHECK(static_cast<double>(hats.count()) ==
          Approx(SurfaceHats::expected_count(geometry, 25.0)).epsilon(0.2));
    for (std::uint32_t node = 0; node < geometry.node_count(); ++node) {
        double sum = 0.0;
        for (const SurfaceHats::Share& share : hats.at(node)) {
            REQUIRE(share.value > 0.0);
            sum += share.value;
        }
        REQUIRE(sum == Approx(geometry.triangles_at(node).empty() ? 0.0 : 1.0));
    }
    for (std::uint32_t a = 0; a < hats.count(); ++a) {
        for (std::uint32_t b = 0; b < a; ++b)
            REQUIRE(glm::distance(geometry.node_positions_mm()[hats.centre(a)],
                                  geometry.node_positions_mm()[hats.centre(b)]) > 0.97 * 25.0);
    }
    // A mesh that is coarse enough already has better use for its own nodes.
    CHECK_FALSE(HatSmoother::is_worth_while(geometry, 25.0));
    CHECK(HatSmoother::is_worth_while(SurfaceGeometry(icosphere(100.0, 6)), 25.0));
}
