#include <array>
#include <catch2/catch.hpp>

#include "experiment/surface/euclidean_kernel.h"
#include "tests/experiment/surface/flat_and_round.h"
#include "tests/support/figures.h"

using namespace overt;
using namespace overt::test;

TEST_CASE("on a plane the kernel in space is the Gaussian, with nothing leaked", "[unit]") {
    const Mesh mesh = flat_square(40.0, 80);
    const SurfaceGeometry geometry(mesh);
    const EuclideanKernel kernel(geometry);
    const SurfacePlace place = place_of_vertex(mesh, 40 * 81 + 40);
    const std::vector<double> density = kernel.density(std::vector{SurfaceWeight{place, 2.0, 5.0}});
    CHECK(mass_of(density, geometry) == Approx(2.0));
    CHECK(density[40 * 81 + 40] == Approx(2.0 / (2.0 * std::numbers::pi * 25.0)).epsilon(0.001));
    CHECK(kernel.leaked_shares(place, std::array{5.0}).front() ==
          Approx(EuclideanKernel::share_on_a_plane).margin(0.002));
}

TEST_CASE("half of the kernel leaks to a second sheet that is near", "[unit]") {
    Mesh mesh = flat_square(40.0, 60);
    add_part(mesh, flat_square(40.0, 60, 0.01), "lid");
    const SurfaceGeometry geometry(mesh);
    const EuclideanKernel kernel(geometry);
    const SurfacePlace place{3600, {0.3, 0.3, 0.4}};
    CHECK(kernel.leaked_shares(place, std::array{6.0}).front() ==
          Approx(0.5 + 0.5 * EuclideanKernel::share_on_a_plane).margin(0.003));
    CHECK(mass_of(kernel.density(std::vector{SurfaceWeight{place, 1.0, 6.0}}), geometry) == Approx(1.0));
}

TEST_CASE("what leaks of several kernels at one place is what leaks of each alone", "[unit]") {
    Mesh mesh = flat_square(40.0, 60);
    add_part(mesh, flat_square(40.0, 60, 7.0), "lid");
    const SurfaceGeometry geometry(mesh);
    const EuclideanKernel kernel(geometry);
    const SurfacePlace place{3600, {0.3, 0.3, 0.4}};
    const std::vector<double> sigmas{6.0, 2.0, 3.5}, shares = kernel.leaked_shares(place, sigmas);
    REQUIRE(shares.size() == 3);
    for (std::size_t i = 0; i < 3; ++i)
        CHECK(shares[i] == Approx(kernel.leaked_shares(place, std::array{sigmas[i]}).front()));
    CHECK(shares[0] > shares[2]);
    CHECK(shares[2] > shares[1]);
}

TEST_CASE("where no vertex is near, the weight goes to the corners of its triangle", "[unit]") {
    const Mesh mesh = flat_square(40.0, 2);
    const SurfaceGeometry geometry(mesh);
    const std::vector<double> density =
        EuclideanKernel(geometry).density(std::vector{SurfaceWeight{{3, {0.2, 0.3, 0.5}}, 1.0, 0.5}});
    CHECK(mass_of(density, geometry) == Approx(1.0));
}
