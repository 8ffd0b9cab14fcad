#include <catch2/catch.hpp>

#include "experiment/surface/surface_smoother.h"
#include "tests/experiment/surface/flat_and_round.h"
#include "tests/support/figures.h"

using namespace overt;
using namespace overt::test;

namespace {

/// Largest difference of two densities as a share of the peak, and the share of the mass that lies elsewhere.
struct Difference {
    double of_peak = 0.0, of_mass = 0.0;
};

template <class Expected>
Difference difference_from(const Expected& expected, const std::vector<double>& density, const Mesh& mesh,
                           const SurfaceGeometry& geometry) {
    const std::vector<double> areas = geometry.vertex_areas_mm2();
    Difference result;
    double peak = 0.0;
    for (std::size_t v = 0; v < density.size(); ++v) {
        const double wanted = expected(glm::dvec3(mesh.positions[v]));
        peak = std::max(peak, wanted);
        result.of_peak = std::max(result.of_peak, std::abs(density[v] - wanted));
        result.of_mass += 0.5 * std::abs(density[v] - wanted) * areas[v];
    }
    result.of_peak /= peak;
    return result;
}

} // namespace

TEST_CASE("on a plane, heat spreads as a Gaussian of the stated width", "[unit]") {
    // Edges of 1 mm; the border is eight sigmas away.
    const Mesh mesh = flat_square(40.0, 80);
    const SurfaceGeometry geometry(mesh);
    const SurfaceSmoother smoother(geometry, 6.0);
    const SurfacePlace middle = place_of_vertex(mesh, 40 * 81 + 40);
    for (const auto& [sigma, peak_share, mass_share] :
         {std::tuple(6.0, 0.018, 0.0055), std::tuple(5.0, 0.023, 0.0065), std::tuple(4.0, 0.03, 0.009)}) {
        const std::vector<double> density = smoother.density(std::vector{SurfaceWeight{middle, 3.0, sigma}});
        const auto gaussian = [sigma = sigma](const glm::dvec3& at) {
            return 3.0 * std::exp(-0.5 * glm::dot(at, at) / (sigma * sigma)) /
                   (2.0 * std::numbers::pi * sigma * sigma);
        };
        const Difference difference = difference_from(gaussian, density, mesh, geometry);
        CAPTURE(sigma, difference.of_peak, difference.of_mass / 3.0);
        CHECK(difference.of_peak < peak_share);
        CHECK(difference.of_mass / 3.0 < mass_share);
        CHECK(mass_of(density, geometry) == Approx(3.0).epsilon(1e-9));
        // The variance is that of the Gaussian to the bit of the mesh: means over times keep it.
        const std::vector<double> areas = geometry.vertex_areas_mm2();
        double variance = 0.0;
        for (std::size_t v = 0; v < density.size(); ++v)
            variance += density[v] * areas[v] * mesh.positions[v].x * mesh.positions[v].x / 3.0;
        CHECK(variance == Approx(sigma * sigma).epsilon(1e-4));
    }
}

TEST_CASE("on a sphere, heat spreads by the sphere's heat kernel", "[unit]") {
    const double radius = 50.0, sigma = 15.0;
    const Mesh mesh = icosphere(radius, 5); // 10,242 vertices, edges of about 1.8 mm
    const SurfaceGeometry geometry(mesh);
    const SurfaceSmoother smoother(geometry, sigma);
    const SurfacePlace source = place_of_vertex(mesh, 0);
    const glm::dvec3 pole = glm::normalize(glm::dvec3(mesh.positions[0]));
    // The sum over l of (2 l + 1) / (4 pi R^2) exp(-l (l + 1) t / R^2) P_l(cos), t = sigma^2 / 2.
    const auto kernel = [&](const glm::dvec3& at) {
        const double x = std::clamp(glm::dot(glm::normalize(at), pole), -1.0, 1.0);
        const double t = 0.5 * sigma * sigma / (radius * radius);
        double before = 1.0, legendre = x, sum = 1.0;
        for (int l = 1; l < 60; ++l) {
            sum += (2.0 * l + 1.0) * std::exp(-l * (l + 1.0) * t) * legendre;
            const double next = ((2.0 * l + 1.0) * x * legendre - l * before) / (l + 1.0);
            before = legendre;
            legendre = next;
        }
        return sum / (4.0 * std::numbers::pi * radius * radius);
    };
    const std::vector<double> density = smoother.density(std::vector{SurfaceWeight{source, 1.0, sigma}});
    const Difference difference = difference_from(kernel, density, mesh, geometry);
    CAPTURE(difference.of_peak, difference.of_mass);
    CHECK(difference.of_peak < 0.012);
    CHECK(difference.of_mass < 0.005);
    CHECK(mass_of(density, geometry) == Approx(1.0).epsilon(1e-9));
}

TEST_CASE("on rough meshes no density is negative, and each piece keeps its mass", "[unit]") {
    // Obtuse triangles, a fin on three-triangle edges, triangles without area, turned fronts and a second
    // sheet a millimetre above the first.
    Mesh mesh = flat_square(20.0, 20, 0.0, 1.3);
    add_part(mesh, flat_square(20.0, 20, 1.0), "lid");
    const auto tip = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.emplace_back(0.0f, 0.0f, -5.0f);
    for (std::uint32_t row = 8; row < 12; ++row)
        mesh.triangles.emplace_back(row * 21 + 10, row * 21 + 11, tip);
    mesh.triangles.emplace_back(0, 1, 2);
    std::swap(mesh.triangles[37].x, mesh.triangles[37].y);
    const SurfaceGeometry geometry(mesh);
    const Pieces pieces = pieces_of(geometry);
    REQUIRE(pieces.count == 2);
    const SurfaceSmoother smoother(geometry, 5.0);
    std::vector<SurfaceWeight> weights;
    for (std::uint32_t t = 5; t < 790; t += 17)
        weights.push_back({{t, {0.2, 0.3, 0.5}}, 1.0 + t % 3, 2.0 + 0.1 * (t % 30)});
    double below = 0.0;
    for (const SurfaceWeight& weight : weights)
        below += weight.weight;
    weights.push_back({{900, {0.5, 0.25, 0.25}}, 7.0, 5.0});

    const std::vector<double> density = smoother.density(weights);
    CHECK(*std::min_element(density.begin(), density.end()) >= 0.0);
    const std::vector<double> areas = geometry.vertex_areas_mm2();
    double masses[2] = {0.0, 0.0};
    for (std::uint32_t v = 0; v < density.size(); ++v)
        masses[pieces.of_node[geometry.node_of(v)]] += density[v] * areas[v];
    CHECK(masses[0] == Approx(below).epsilon(1e-9));
    CHECK(masses[1] == Approx(7.0).epsilon(1e-9));
}

TEST_CASE("a map is the same to the bit with other maps, alone, and on one thread", "[unit]") {
    const Mesh mesh = icosphere(50.0, 3);
    const SurfaceGeometry geometry(mesh);
    const SurfaceSmoother smoother(geometry, 12.0);
    std::vector<std::vector<SurfaceWeight>> maps(19);
    for (std::uint32_t i = 0; i < 300; ++i)
        maps[i % 18].push_back({{i * 4 % 1280, {0.1, 0.6, 0.3}}, 1.0 + i % 7, 7.0 + i % 5});
    const std::vector<std::vector<double>> together = smoother.densities(maps);
    CHECK(together == smoother.densities(maps, 1));
    for (const std::size_t i : {0, 7, 8, 17})
        CHECK(together[i] == smoother.density(maps[i]));
    CHECK(together[18] == std::vector<double>(mesh.positions.size(), 0.0));
}

TEST_CASE("the map of weights of several widths is the sum of their maps", "[unit]") {
    const Mesh mesh = flat_square(30.0, 30);
    const SurfaceGeometry geometry(mesh);
    const SurfaceSmoother smoother(geometry, 6.0);
    const std::vector<SurfaceWeight> weights{
        {{300, {1, 0, 0}}, 1.0, 6.0}, {{900, {0, 0.5, 0.5}}, 2.5, 3.9}, {{901, {0.3, 0.3, 0.4}}, 0.5, 5.1}};
    const std::vector<double> both = smoother.density(weights);
    std::vector<double> sum(both.size(), 0.0);
    for (const SurfaceWeight& weight : weights) {
        const std::vector<double> one = smoother.density(std::vector{weight});
        for (std::size_t v = 0; v < sum.size(); ++v)
            sum[v] += one[v];
    }
    for (std::size_t v = 0; v < sum.size(); ++v)
        REQUIRE(both[v] == Approx(sum[v]).margin(1e-14));
}

TEST_CASE("duplicate vertices have the density of the surface they lie on", "[unit]") {
    const Mesh mesh = flat_square(10.0, 10), loose = with_loose_triangles(mesh);
    const SurfaceGeometry whole(mesh), pieces(loose);
    const std::vector<SurfaceWeight> weights{{{77, {0.2, 0.2, 0.6}}, 1.0, 4.0}};
    const std::vector<double> expected = SurfaceSmoother(whole, 4.0).density(weights);
    const std::vector<double> density = SurfaceSmoother(pieces, 4.0).density(weights);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        for (int k = 0; k < 3; ++k)
            REQUIRE(density[loose.triangles[t][k]] == Approx(expected[mesh.triangles[t][k]]).margin(1e-12));
    }
}

TEST_CASE("the times of a flow have the mean asked for and are narrow about it", "[unit]") {
    const HeatTimes times(20.0);
    for (const double time : {20.0, 15.0, 10.0, 7.7, 2.0, 0.6}) {
        const std::vector<double> weights = times.weights(time);
        // The mean of exp(-r s) over the times.
        const auto transform = [&](double rate) {
            const double x = 1.0 / (1.0 + times.step() * rate);
            double sum = 0.0;
            for (std::size_t k = 0; k < weights.size(); ++k)
                sum += weights[k] * std::cos(double(k) * std::acos(2.0 * x - 1.0));
            return x * sum;
        };
        CAPTURE(time, times.relative_variance(time));
        CHECK(transform(0.0) == Approx(1.0).epsilon(1e-12));
        // Its logarithm begins with -r mean + r^2 variance / 2.
        const double small = 1e-3 / time;
        const double slope = std::log(transform(small)) / -small;
        CHECK(slope == Approx(time).epsilon(1e-3));
        CHECK((time - slope) / small * 2.0 / (time * time) ==
              Approx(times.relative_variance(time)).epsilon(0.05).margin(1e-4));
        CHECK(times.relative_variance(time) < (time >= 7.7 ? 0.0145 : 1.0));
        // A density that is nowhere negative has a transform that falls, ever slower.
        for (double rate = 0.0; rate < 50.0 / time; rate += 0.5 / time) {
            const double now = transform(rate), next = transform(rate + 0.5 / time);
            REQUIRE(now > next);
            REQUIRE(now - next > next - transform(rate + 1.0 / time));
            REQUIRE(next > 0.0);
        }
    }
}
