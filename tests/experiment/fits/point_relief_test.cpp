#include "experiment/fits/point_relief.h"

#include <cmath>

#include <catch2/catch.hpp>

#include "experiment/base/random.h"

using namespace overt;

namespace {

/// z = 0.3 x + 0.1 y + 0.5 x^2 - 0.2 x y + 0.4 y^2 at places that are strewn about.
double height_at(double x, double y) { return 0.3 * x + 0.1 * y + 0.5 * x * x - 0.2 * x * y + 0.4 * y * y; }

std::vector<ReliefSite> strewn(int count, std::uint64_t seed = 1) {
    RandomStream random(seed, "places");
    std::vector<ReliefSite> sites;
    for (int i = 0; i < count; ++i) {
        const double x = random.uniform(-3.0, 3.0), y = random.uniform(-2.0, 2.0);
        sites.push_back({x, y, 0.3 + x - 0.2 * y, 0.1 - 0.2 * x + 0.8 * y});
    }
    return sites;
}

} // namespace

TEST_CASE("a surface of second degree comes back from its gradients alone", "[unit]") {
    const std::vector<ReliefSite> sites = strewn(60);
    const std::optional<PointRelief> relief = point_relief(sites);
    REQUIRE(relief);
    double mean = 0.0;
    for (const ReliefSite& site : sites)
        mean += height_at(site.x, site.y) / 60.0;
    double sum = 0.0;
    for (std::size_t i = 0; i < sites.size(); ++i) {
        CHECK(relief->height[i] == Approx(height_at(sites[i].x, sites[i].y) - mean).margin(1e-9));
        sum += relief->height[i];
    }
    CHECK(sum == Approx(0.0).margin(1e-9));
    CHECK(relief->residual_rms == Approx(0.0).margin(1e-9));
}

TEST_CASE("gradients that contradict each other leave a residual", "[unit]") {
    std::vector<ReliefSite> sites = strewn(60);
    for (ReliefSite& site : sites) { // a whirl has no height
        site.rise_x = -site.y;
        site.rise_y = site.x;
    }
    CHECK(point_relief(sites)->residual_rms > 0.1);
}

TEST_CASE("neighbours are those of a Delaunay triangulation", "[unit]") {
    // A square with its middle: four sides, four spokes, and no diagonal.
    const std::vector<ReliefSite> square{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0.5, 0.5}};
    const std::vector<ReliefEdge> edges = neighbours_among(square);
    CHECK(edges == std::vector<ReliefEdge>{{0, 1}, {0, 3}, {0, 4}, {1, 2}, {1, 4}, {2, 3}, {2, 4}, {3, 4}});
    // Euler: of n places in general position with h on the hull there are 3n - 3 - h edges, before long ones
    // go.
    CHECK(neighbours_among(strewn(60), 1e9).size() > 3 * 60 - 3 - 30);
    CHECK(neighbours_among(strewn(60), 1e9).size() <= 3 * 60 - 3 - 3);
    CHECK(neighbours_among(strewn(60)).size() < neighbours_among(strewn(60), 1e9).size());
    // In any unit.
    std::vector<ReliefSite> small = strewn(30);
    for (ReliefSite& site : small) {
        site.x *= 1e-6;
        site.y *= 1e-6;
    }
    CHECK(neighbours_among(small) == neighbours_among(strewn(30)));
}

TEST_CASE("there is no relief of two places, or of places on one line", "[unit]") {
    CHECK_FALSE(point_relief(std::vector<ReliefSite>{{0, 0, 1, 0}, {1, 0, 1, 0}}));
    CHECK_FALSE(point_relief(std::vector<ReliefSite>{{0, 0}, {1, 1}, {2, 2}, {3, 3}}));
}
