#include "experiment/spectra/spectra.h"

#include <fstream>
#include <numeric>
#include <sstream>

#include <catch2/catch.hpp>

#include "experiment/base/content_hash.h"
#include "experiment/base/error.h"

using namespace overt;

TEST_CASE("a perfect white under D65 is (1, 1, 1), and a grey is as grey as it is", "[unit]") {
    Spectrum grey;
    grey.fill(0.18);
    const glm::dvec3 colour = linear_rec709_of(grey);
    for (int channel = 0; channel < 3; ++channel)
        CHECK(colour[channel] == Approx(0.18).epsilon(1e-12));
}

TEST_CASE("the colour matching functions integrate to the CIE's equal sums, and D65 has its chromaticity",
          "[unit]") {
    // CIE 15: the three functions have the same integral, 106.8566 nm for y; the bins leave out a little at
    // both ends.
    double sums[3] = {}, xyz[3] = {};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        sums[axis] =
            bin_width_nm * std::accumulate(cie1931_xyz()[axis].begin(), cie1931_xyz()[axis].end(), 0.0);
        for (std::size_t bin = 0; bin < spectral_bins; ++bin)
            xyz[axis] += cie1931_xyz()[axis][bin] * illuminant_d65()[bin];
        CHECK(sums[axis] == Approx(106.857).epsilon(3e-3));
    }
    const double total = xyz[0] + xyz[1] + xyz[2];
    CHECK(xyz[0] / total == Approx(0.3127).margin(2e-4));
    CHECK(xyz[1] / total == Approx(0.3290).margin(5e-4));
}

TEST_CASE("a dielectric reflects by Fresnel's formula, and nothing where the indices match", "[unit]") {
    ComplexIndex glass;
    glass.n.fill(1.5);
    CHECK(normal_reflectance(glass, 1.0)[7] == Approx(0.04));
    CHECK(normal_reflectance(glass, 1.5)[7] == Approx(0.0).margin(1e-15));
}

TEST_CASE("gold is yellow and silver nearly white; what is neither is refused", "[unit]") {
    const glm::dvec3 gold = linear_rec709_of(normal_reflectance(metal_index("Au"), 1.0));
    const glm::dvec3 silver = linear_rec709_of(normal_reflectance(metal_index("Ag"), 1.0));
    // Mitsuba's preset under D65 at normal incidence: linear sRGB (1.022, 0.782, 0.344).
    CHECK(gold.x == Approx(1.022).margin(4e-3));
    CHECK(gold.y == Approx(0.782).margin(4e-3));
    CHECK(gold.z == Approx(0.344).margin(4e-3));
    CHECK(silver.z > 0.9);
    CHECK(silver.x / silver.z < 1.08);
    CHECK_THROWS_WITH(metal_index("Cu"), Catch::Contains("Cu") && Catch::Contains("Au and Ag"));
}

TEST_CASE("each asset has the checksum that assets/README.md states", "[unit]") {
    const std::filesystem::path folder = std::filesystem::path(OVERT_SOURCE_DIR) / "assets";
    std::stringstream text;
    text << std::ifstream(folder / "README.md").rdbuf();
    int assets = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        // The report's page is a part of the program, and changes with it.
        if (!entry.is_regular_file() || entry.path().filename() == "README.md" ||
            entry.path().parent_path().filename() == "report")
            continue;
        ++assets;
        CAPTURE(entry.path());
        CHECK_THAT(text.str(), Catch::Contains(hash_of_file(entry.path())));
    }
    CHECK(assets >= 4);
}
