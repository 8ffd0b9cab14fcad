#include <catch2/catch.hpp>

#include "render/bake/conductor.h"
#include "render/bake/thin_film.h"

using namespace overt;

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
