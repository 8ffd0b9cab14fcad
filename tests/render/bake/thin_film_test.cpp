#include <catch2/catch.hpp>

#include "render/bake/conductor.h"
#include "render/bake/thin_film.h"

using namespace overt;

TEST_CASE("thin films have the reflectances of an independent reckoning", "[unit]") {
    struct Known {
        double film, nm, body, cosine, at_450, at_550, at_650;
    };
    for (const Known& known : {Known{1.33, 400, 1.0, 1.0, .064806, .003471, .064569},
                               {1.33, 400, 1.0, 0.5, .089956, .190982, .112349},
                               {1.5, 300, 1.33, 1.0, .020059, .058416, .060497},
                               {1.5, 300, 1.33, 0.5, .114239, .109722, .070864},
                               {1.3, 400, 1.5, 1.0, .015240, .036018, .007148},
                               {1.3, 400, 1.5, 0.5, .055241, .032341, .070966}}) {
        CAPTURE(known.film, known.nm, known.cosine);
        CHECK(film_reflectance(450, known.film, known.nm, known.body, known.cosine) ==
              Approx(known.at_450).margin(2e-6));
        CHECK(film_reflectance(550, known.film, known.nm, known.body, known.cosine) ==
              Approx(known.at_550).margin(2e-6));
        CHECK(film_reflectance(650, known.film, known.nm, known.body, known.cosine) ==
              Approx(known.at_650).margin(2e-6));
    }
    const ComplexIndex& gold = metal_index("Au");
    const auto of_gold = [&](double wavelength, double cosine) {
        const auto bin = static_cast<std::size_t>((wavelength - first_bin_centre_nm) / bin_width_nm);
        return film_reflectance(wavelength, 2.4, 200, {gold.n[bin], gold.k[bin]}, cosine);
    };
    CHECK(of_gold(450, 1.0) == Approx(.143766).margin(2e-5));
    CHECK(of_gold(550, 1.0) == Approx(.898245).margin(2e-5));
    CHECK(of_gold(650, 0.5) == Approx(.837115).margin(2e-5));
}

TEST_CASE("a film of no thickness is none, and its bins are means", "[unit]") {
    const ComplexIndex& gold = metal_index("Au");
    for (const double cosine : {1.0, 0.6, 0.1}) {
        const Bins thin = film_over_metal(gold, 1.5, 1e-6, cosine);
        for (std::size_t bin = 0; bin < spectral_bins; ++bin)
            CHECK(thin.value[bin] ==
                  Approx(conductor_fresnel(gold.n[bin], gold.k[bin], cosine)).margin(1e-5));
    }
    // Far more fringes than a bin can show: between what two surfaces give alike at all phases.
    const Bins thick = film_over_metal(gold, 1.5, 3000.0, 1.0);
    for (std::size_t bin = 0; bin < spectral_bins; ++bin) {
        CHECK(thick.value[bin] > 0.0f);
        CHECK(thick.value[bin] < 1.0f);
    }
}
