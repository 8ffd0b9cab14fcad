#include <algorithm>

#include <catch2/catch.hpp>

#include "bake/bake_support.h"

using namespace overt;

TEST_CASE("a metal that reflects all light is as bright as its surroundings everywhere", "[unit]") {
    const test::WhiteMetal white;
    const Mesh mesh = test::bust();
    const BakeScene scene(mesh, test::material_of(MaterialKind::smooth_conductor, white.file()));
    const SpectralLight light(test::even_light(), 1.0);
    const LinearImage picture =
        to_rec709(test::baked(scene, light, test::front_view(mesh, 48), {.samples = 4}));
    float worst = 0.0f;
    int lit = 0;
    for (const glm::vec4& pixel : picture.pixels) {
        for (int channel = 0; channel < 3; ++channel)
            worst = std::max(worst, std::abs(pixel[channel] - pixel.a));
        lit += pixel.a > 0.0f;
    }
    CHECK(lit > 300);
    CHECK(worst < 2e-6f);
}

TEST_CASE("gold in even light has the colour of its reflectance at normal incidence in its middle",
          "[unit]") {
    const Mesh ball = test::ball({0, 0, 0}, 1.0, 96, 192);
    const BakeScene scene(ball, test::material_of(MaterialKind::smooth_conductor));
    const SpectralLight light(test::even_light(), 1.0);
    const LinearImage picture =
        to_rec709(test::baked(scene, light, test::front_view(ball, 33), {.samples = 16}));
    const glm::dvec3 expected = linear_rec709_of(normal_reflectance(metal_index("Au"), 1.0));
    for (int channel = 0; channel < 3; ++channel)
        CHECK(picture.at(16, 16)[channel] == Approx(expected[channel]).epsilon(0.002));
}
