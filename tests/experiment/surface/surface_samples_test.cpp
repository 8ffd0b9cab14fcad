/// Samples of surfaces: how far apart, for how much, beside whom.
#include "experiment/surface/surface_samples.h"

#include <algorithm>
#include <numeric>

#include <catch2/catch.hpp>

#include "tests/experiment/surface/flat_and_round.h"

using namespace overt;

TEST_CASE("samples stand for all of a surface, and none for much more of it than another", "[unit]") {
    for (const Mesh& mesh : {test::flat_square(50.0, 60), test::icosphere(40.0, 4)}) {
        const SurfaceGeometry geometry(mesh);
        constexpr double spacing_mm = 6.0;
        const SurfaceHats hats(geometry, spacing_mm);
        const SurfaceSamples samples(geometry, hats);
        REQUIRE(samples.count() < geometry.node_count() / 4);
        const std::vector<double> areas = samples.areas_mm2();
        CHECK(std::accumulate(areas.begin(), areas.end(), 0.0) ==
              Approx(geometry.total_area_mm2()).epsilon(1e-9));
        CHECK(*std::max_element(areas.begin(), areas.end()) < 3.0 * spacing_mm * spacing_mm);
        // No place is farther from its sample than the spacing, as the crow flies still less.
        for (std::uint32_t node = 0; node < geometry.node_count(); ++node) {
            const std::uint32_t sample = samples.nearest(node);
            REQUIRE(sample != SurfaceSamples::none);
            CHECK(glm::distance(geometry.node_positions_mm()[node],
                                geometry.node_positions_mm()[samples.nodes()[sample]]) <= spacing_mm + 1e-9);
        }
    }
}

TEST_CASE("samples have the area of what counts alone", "[unit]") {
    const Mesh mesh = test::flat_square(50.0, 60);
    const SurfaceGeometry geometry(mesh);
    const SurfaceHats hats(geometry, 6.0);
    const SurfaceSamples samples(geometry, hats), all(geometry);
    std::vector<char> counts;
    double left = 0.0;
    for (std::uint32_t node = 0; node < geometry.node_count(); ++node) {
        counts.push_back(geometry.node_positions_mm()[node].x < 0.0);
        left += counts.back() ? geometry.node_areas_mm2()[node] : 0.0;
    }
    for (const SurfaceSamples* of : {&samples, &all}) {
        const std::vector<double> areas = of->areas_mm2(counts);
        CHECK(std::accumulate(areas.begin(), areas.end(), 0.0) == Approx(left).epsilon(1e-9));
    }
    CHECK(all.count() == geometry.node_count());
}

TEST_CASE("samples beside each other know of each other, and all of one sheet hang together", "[unit]") {
    Mesh mesh = test::flat_square(50.0, 40, 0.0);
    // A second sheet, close above: nothing passes from one to the other.
    const Mesh above = test::flat_square(50.0, 40, 0.5);
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), above.positions.begin(), above.positions.end());
    for (const glm::uvec3& t : above.triangles)
        mesh.triangles.push_back(t + first);
    mesh.triangle_parts.assign(mesh.triangles.size(), PartIndex{0});
    const SurfaceGeometry geometry(mesh);
    const SurfaceHats hats(geometry, 8.0);
    const SurfaceSamples samples(geometry, hats);
    const auto neighbours = [&](std::uint32_t sample) {
        return samples.neighbours().subspan(samples.neighbours_begin()[sample],
                                            samples.neighbours_begin()[sample + 1] -
                                                samples.neighbours_begin()[sample]);
    };
    std::vector<bool> is_reached(samples.count(), false);
    std::vector<std::uint32_t> open{0};
    is_reached[0] = true;
    const double height = geometry.node_positions_mm()[samples.nodes()[0]].z;
    while (!open.empty()) {
        const std::uint32_t sample = open.back();
        open.pop_back();
        CHECK(geometry.node_positions_mm()[samples.nodes()[sample]].z == height);
        for (const std::uint32_t next : neighbours(sample)) {
            CHECK(std::ranges::binary_search(neighbours(next), sample));
            if (!is_reached[next]) {
                is_reached[next] = true;
                open.push_back(next);
            }
        }
    }
    std::size_t on_sheet = 0;
    for (const std::uint32_t node : samples.nodes())
        on_sheet += geometry.node_positions_mm()[node].z == height;
    CHECK(static_cast<std::size_t>(std::ranges::count(is_reached, true)) == on_sheet);
}
