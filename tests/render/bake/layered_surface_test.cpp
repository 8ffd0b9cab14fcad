#include <catch2/catch.hpp>

#include "render/bake/surface_laws.h"

using namespace overt;

TEST_CASE("layered surfaces keep to the laws of light, and to numbers that others worked out", "[unit]") {
    const std::vector<SurfaceLaw> laws = surface_laws();
    CHECK(laws.size() > 150);
    for (const SurfaceLaw& law : laws) {
        CAPTURE(law.what, law.ours, law.known, law.tolerance);
        CHECK(law.holds());
    }
}
