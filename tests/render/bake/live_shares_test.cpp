/// What live frames know of a material, and how far pictures are apart.
#include "render/bake/live_shares.h"

#include <cmath>

#include <catch2/catch.hpp>

#include "experiment/spectra/metal_table.h"
#include "render/bake/light_colour.h"
#include "render/bake/surface_laws.h"
#include "tests/render/bake/bake_support.h"

using namespace overt;

namespace {

double whole_of(const LiveShares& shares, std::size_t row) {
    return static_cast<double>(shares.mirrored[row].g + shares.mirrored[row].a + shares.even[row].g);
}

} // namespace

TEST_CASE("differences of colours are those that Sharma, Wu and Dalal list", "[unit]") {
    struct Pair {
        glm::dvec3 one, other;
        double apart;
    };
    for (const Pair& pair :
         {Pair{{50, 2.6772, -79.7751}, {50, 0, -82.7485}, 2.0425}, Pair{{50, -1, 2}, {50, 0, 0}, 2.3669},
          Pair{{50, 2.49, -0.001}, {50, -2.49, 0.0009}, 7.1792}, Pair{{50, 2.5, 0}, {50, 0, -2.5}, 4.3065},
          Pair{{50, 2.5, 0}, {73, 25, -18}, 27.1492},
          Pair{{60.2574, -34.0099, 36.2677}, {60.4626, -34.1751, 39.4387}, 1.2644},
          Pair{{2.0776, 0.0795, -1.135}, {0.9033, -0.0636, -0.5514}, 0.9082}}) {
        CHECK(ciede2000(pair.one, pair.other) == Approx(pair.apart).margin(5e-5));
        CHECK(ciede2000(pair.other, pair.one) == Approx(pair.apart).margin(5e-5));
        CHECK(ciede2000(pair.one, pair.one) == 0.0);
    }
}

TEST_CASE("live frames share light as paths do: white keeps all of it, rough metal loses what paths lose",
          "[unit]") {
    MaterialSettings white = test::material_of(MaterialKind::plastic);
    white.reflectance = glm::dvec3(1.0);
    white.roughness = 0.2;
    const LiveShares plastic = live_shares(white);
    REQUIRE(plastic.mirrored.size() == LiveShares::rows);
    REQUIRE(plastic.even.size() == LiveShares::rows);
    for (std::size_t row = 0; row < plastic.even.size(); ++row) {
        CAPTURE(row);
        CHECK(whole_of(plastic, row) == Approx(1.0).margin(2e-3));
        CHECK(plastic.mirrored[row].a == 0.0f);
    }
    CHECK(plastic.mirrored.back().g == Approx(0.038).margin(0.002)); // facts of E at alpha 0.2, cosine 1

    MaterialSettings car = test::material_of(MaterialKind::metallic_roughness);
    car.reflectance = glm::dvec3(1.0);
    car.metallic = 0.5;
    car.clear_coat = 1.0;
    const LiveShares coated = live_shares(car);
    CHECK(coated.mirrored.back().a == Approx(0.04).margin(0.002));
    for (std::size_t row = 0; row < coated.even.size(); ++row)
        CHECK(whole_of(coated, row) <= 1.005);
    CHECK(whole_of(coated, LiveShares::rows - 1) > 0.9);

    // Polished gold is as its table has it; rough gold that much less; all its light brings some back.
    MaterialSettings gold = test::material_of(MaterialKind::smooth_conductor);
    gold.metal = "Au";
    const glm::dvec3 table = linear_rec709_of(normal_reflectance(load_metal("Au"), 1.0));
    const LiveShares polished = live_shares(gold);
    for (int channel = 0; channel < 3; ++channel)
        CHECK(polished.mirrored.back()[channel] == Approx(table[channel]).margin(2e-3));
    gold.kind = MaterialKind::rough_conductor;
    gold.roughness = 0.3;
    const LiveShares rough = live_shares(gold);
    CHECK(rough.mirrored.back().r == Approx(0.8774 * table.r).epsilon(0.01)); // alpha 0.3, cosine 1
    CHECK(rough.even.back().r == 0.0f);
    gold.multiple_scattering = true;
    const LiveShares whole = live_shares(gold);
    CHECK(whole.mirrored.back().r == Approx(rough.mirrored.back().r).margin(1e-3));
    CHECK(whole.even.back().r > 0.05f);
    // A coat takes its share on the way in and on the way out.
    gold.clear_coat = 1.0;
    const LiveShares lacquered = live_shares(gold);
    const float taken = lacquered.mirrored.back().a;
    CHECK(taken == Approx(0.04).margin(0.002));
    CHECK(lacquered.mirrored.back().r == Approx((1.0f - taken) * (1.0f - taken) * whole.mirrored.back().r));
    CHECK(lacquered.even.back().r < whole.even.back().r);
    gold.clear_coat = 0.0;
    gold.multiple_scattering = false;
    gold.anisotropy = 0.5;
    CHECK(live_shares(gold).mirrored.back().r < rough.mirrored.back().r);

    MaterialSettings glass = test::material_of(MaterialKind::glass);
    const LiveShares clear = live_shares(glass);
    for (std::size_t row = 0; row < clear.even.size(); ++row)
        CHECK(whole_of(clear, row) == Approx(1.0).margin(1e-4));
    CHECK(clear.mirrored.back().g == Approx(0.04).margin(1e-4));
    glass.absorbance = {0.5, 0.0, 0.0};
    CHECK(live_shares(glass).even.back().r == Approx(0.96 * std::exp(-1.0)).margin(1e-3));
    CHECK(live_shares(glass).even.back().g == Approx(0.96).margin(1e-3));
}
