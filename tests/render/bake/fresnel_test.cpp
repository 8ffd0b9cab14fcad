#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "render/bake/conductor.h"

using namespace overt;

TEST_CASE("a metal reflects ((n-1)^2 + k^2) / ((n+1)^2 + k^2) head-on and everything at a grazing angle",
          "[unit]") {
    for (const auto& [n, k] : {std::pair{0.2, 3.0}, {1.5, 1.9}, {0.05, 2.1}, {3.0, 0.5}}) {
        const double head_on = ((n - 1) * (n - 1) + k * k) / ((n + 1) * (n + 1) + k * k);
        CHECK(conductor_fresnel(n, k, 1.0) == Approx(head_on).epsilon(1e-12));
        CHECK(conductor_fresnel(n, k, 1e-7) == Approx(1.0).margin(5e-5));
    }
}

TEST_CASE("a metal without absorption reflects like a dielectric", "[unit]") {
    for (const double n : {1.3, 1.4, 2.0}) {
        for (double cosine = 0.01; cosine <= 1.0; cosine += 0.033) {
            CHECK(conductor_fresnel(n, 0.0, cosine) ==
                  Approx(dielectric_fresnel(static_cast<float>(n), static_cast<float>(cosine))).margin(2e-6));
        }
    }
}

TEST_CASE("a dielectric reflects the same share from both sides of one path", "[unit]") {
    constexpr float ior = 1.4f;
    for (float cosine = 0.02f; cosine <= 1.0f; cosine += 0.02f) {
        const float inside = std::sqrt(1.0f - (1.0f - cosine * cosine) / (ior * ior));
        CHECK(dielectric_fresnel(ior, cosine) == Approx(dielectric_fresnel(1.0f / ior, inside)).margin(5e-5));
    }
    CHECK(dielectric_fresnel(ior, 1.0f) == Approx(0.16 / 5.76));
    CHECK(dielectric_fresnel(1.0f / ior, 0.3f) == 1.0f);
    // Brewster: light polarised along the plane passes whole, so the rest is half of the other.
    const float brewster = 1.0f / std::sqrt(1.0f + ior * ior);
    CHECK(dielectric_fresnel(ior, brewster) ==
          Approx(0.5 * std::pow((1.0 - 1.4 * 1.4) / (1.0 + 1.4 * 1.4), 2.0)).epsilon(1e-4));
}

TEST_CASE("the table of a metal is within 2e-5 of Fresnel's equations", "[unit]") {
    for (const char* name : {"Au", "Ag"}) {
        for (const double outside : {1.0, 1.4}) {
            const ComplexIndex& metal = metal_index(name);
            const ConductorTable table(metal, outside);
            double worst = 0.0;
            for (double cosine = 0.0; cosine <= 1.0; cosine += 0.000617) {
                Bins bins = Bins::filled(1.0f);
                table.multiply_into(bins, static_cast<float>(cosine));
                for (std::size_t bin = 0; bin < spectral_bins; ++bin) {
                    const double exact =
                        conductor_fresnel(metal.n[bin] / outside, metal.k[bin] / outside, cosine);
                    worst = std::max(worst, std::abs(double{bins.value[bin]} - exact));
                }
            }
            CHECK(worst < 2e-5);
        }
    }
}

TEST_CASE("absorption follows Beer and Lambert to 3e-7 and never turns negative", "[unit]") {
    Bins absorbance{};
    for (std::size_t i = 0; i < Bins::padded; ++i)
        absorbance.value[i] = 0.13f * static_cast<float>(i);
    for (const float path : {0.0f, 0.01f, 1.0f, 7.3f, 1000.0f}) {
        Bins bins = Bins::filled(1.0f);
        absorb(bins, absorbance, path);
        for (std::size_t i = 0; i < Bins::padded; ++i) {
            const double depth = double{absorbance.value[i]} * double{path};
            const double expected = std::exp(-std::min(depth, 86.0));
            CHECK(bins.value[i] >= 0.0f);
            CHECK(bins.value[i] ==
                  Approx(expected).epsilon(3e-7 + 1.3e-7 * std::min(depth, 86.0)).margin(1e-37));
        }
    }
}
