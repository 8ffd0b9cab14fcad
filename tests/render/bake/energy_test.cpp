#include <algorithm>
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "render/bake/conductor.h"
#include "render/bake/microfacets.h"
#include "tests/render/bake/bake_support.h"

using namespace overt;

namespace {

/// Largest distance of a channel from 1 where the figure is, over all pixels; and how many those are.
struct FurnaceResult {
    double worst = 0.0, mean = 0.0;
    int lit = 0;
};

FurnaceResult furnace(const Mesh& mesh, const MaterialSettings& material, int samples) {
    const BakeScene scene(mesh, material);
    const SpectralLight light(test::even_light(), 1.0);
    const SpectralFrame frame = test::baked(scene, light, test::front_view(mesh, 48), {.samples = samples});
    const LinearImage picture = to_rec709(frame);
    FurnaceResult result;
    for (const glm::vec4& pixel : picture.pixels) {
        if (pixel.a == 0.0f)
            continue;
        ++result.lit;
        for (int channel = 0; channel < 3; ++channel) {
            const auto share = static_cast<double>(pixel[channel] / pixel.a);
            result.worst = std::max(result.worst, std::abs(share - 1.0));
            result.mean += share / 3.0;
        }
    }
    result.mean /= result.lit;
    return result;
}

/// Share of light that GGX mirrors of reflectance 1 return head-on when what meets a second one is lost.
double single_scatter_share(double alpha) {
    constexpr int steps = 4000;
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) {
        // The visible normals of a head-on view have tan^2 = alpha^2 u / (1 - u).
        const double u = (i + 0.5) / steps, tan_squared = alpha * alpha * u / (1.0 - u);
        const double cosine = (1.0 - tan_squared) / (1.0 + tan_squared); // of twice the angle
        sum += ggx_visible_share({0.0f, static_cast<float>(std::sqrt(std::max(0.0, 1.0 - cosine * cosine))),
                                  static_cast<float>(cosine)},
                                 static_cast<float>(alpha)) /
               steps;
    }
    return sum;
}

} // namespace

TEST_CASE("no kind of material gives more light than it gets, and none loses much of it", "[unit]") {
    const test::WhiteMetal white;
    for (const MaterialKindRow& row : material_kinds) {
        CAPTURE(row.name);
        MaterialSettings material = test::material_of(row.kind, white.file());
        material.reflectance = glm::dvec3(1.0, 1.0, 1.0);
        material.coat_absorbance = {0.0, 0.0, 0.0};
        material.absorption_per_mm = {0.0, 0.0, 0.0};
        material.density = 0.05; // some forty free flights across
        // What chooses between coat and body by chance is noisier than a mirror.
        const FurnaceResult lit = furnace(test::bust(), material, 64);
        CHECK(lit.mean <= 1.0015);
        CHECK(lit.mean >= 0.95);
    }
}

TEST_CASE("a metal that reflects all light is as bright as its surroundings everywhere", "[unit]") {
    const test::WhiteMetal white;
    const FurnaceResult smooth =
        furnace(test::bust(), test::material_of(MaterialKind::smooth_conductor, white.file()), 4);
    CHECK(smooth.lit > 300);
    CHECK(smooth.worst < 2e-6);
}

TEST_CASE("a matt white surface is as bright as its surroundings", "[unit]") {
    MaterialSettings material = test::material_of(MaterialKind::diffuse);
    material.reflectance = glm::dvec3(1.0, 1.0, 1.0);
    CHECK(furnace(test::bust(), material, 16).worst < 2e-6);
}

TEST_CASE("a dark surface is as bright as its reflectance, though chance ends most of its paths", "[unit]") {
    // A ball sees nothing of itself: each path meets it once and carries its reflectance out. Paths that
    // carry less than a tenth go on by chance, which must be right in the mean.
    for (const double reflectance : {0.05, 0.02}) {
        MaterialSettings material = test::material_of(MaterialKind::diffuse);
        material.reflectance = glm::dvec3(reflectance, reflectance, reflectance);
        const FurnaceResult dark = furnace(test::ball({0.0, 0.0, 0.0}, 50.0), material, 256);
        CHECK(dark.lit > 300);
        CHECK(dark.mean == Approx(reflectance).epsilon(0.02));
    }
}

TEST_CASE("a clear coat on a metal that reflects all light loses next to nothing and adds nothing",
          "[unit]") {
    const test::WhiteMetal white;
    MaterialSettings material = test::material_of(MaterialKind::coated_conductor, white.file());
    material.coat_absorbance = {0.0, 0.0, 0.0};
    material.coat_bump_width = 0.2;
    // Paths that are caught between the pieces are given up after many events.
    const FurnaceResult coated = furnace(test::bust(), material, 8);
    CHECK(coated.mean == Approx(1.0).margin(3e-4));
}

TEST_CASE("a rough metal loses what its micro-mirrors send to one another, and no more", "[unit]") {
    const test::WhiteMetal white;
    for (const double alpha : {0.13, 0.5}) {
        MaterialSettings material = test::material_of(MaterialKind::rough_conductor, white.file());
        material.roughness = alpha;
        // A box has a flat front, seen head-on up to 6 degrees.
        const double expected = single_scatter_share(alpha);
        const FurnaceResult rough = furnace(test::box({-1, -0.1, -1}, {1, 0.1, 1}), material, 64);
        CHECK(rough.mean == Approx(expected).margin(0.003));
        CHECK(rough.mean <= 1.0);
    }
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
        CHECK(double{picture.at(16, 16)[channel]} == Approx(expected[channel]).epsilon(0.002));
}

TEST_CASE("light that gold has mirrored twice has the square of its spectrum, not of its colour", "[unit]") {
    // Two mirrors at a right angle, as a groove seen along its bisector: each ray meets both at 45 degrees.
    Mesh groove;
    groove.positions = {{-1, -1, -1}, {0, 0, -1}, {0, 0, 1}, {-1, -1, 1}, {1, -1, -1}, {1, -1, 1}};
    groove.triangles = {{0, 1, 2}, {0, 2, 3}, {1, 4, 5}, {1, 5, 2}};
    groove.triangle_parts.assign(4, 0);
    groove.part_names = {"groove"};
    const BakeScene scene(groove, test::material_of(MaterialKind::smooth_conductor));
    const SpectralLight light(test::even_light(), 1.0);
    SceneView view = test::front_view(groove, 32);
    view.view.camera = {{0.0, -500.0, 0.0}, {0.0, 0.0, 0.0}, {0.2}};
    const SpectralFrame frame = test::baked(scene, light, view, {.samples = 1});
    const LinearImage picture = to_rec709(frame);

    Spectrum twice, twice_head_on = normal_reflectance(metal_index("Au"), 1.0);
    for (std::size_t bin = 0; bin < spectral_bins; ++bin) {
        const double once =
            conductor_fresnel(metal_index("Au").n[bin], metal_index("Au").k[bin], std::sqrt(0.5));
        twice[bin] = once * once;
        twice_head_on[bin] *= twice_head_on[bin];
    }
    const glm::dvec3 expected = linear_rec709_of(twice);
    for (int channel = 0; channel < 3; ++channel)
        CHECK(double{picture.at(10, 16)[channel]} == Approx(expected[channel]).margin(0.001));
    // Head-on, against the figures that were reckoned by hand, and against the square of the colour.
    const glm::dvec3 by_hand(1.003, 0.619, 0.092), by_colour(1.044, 0.611, 0.118);
    const glm::dvec3 head_on = linear_rec709_of(twice_head_on);
    CHECK(glm::length(head_on - by_hand) < 0.003);
    CHECK(glm::length(head_on - by_colour) > 0.04);
}

TEST_CASE("a coat takes away light by Beer and Lambert's law on the way in and out", "[unit]") {
    const test::WhiteMetal white;
    const Mesh ball = test::ball({0, 0, 0}, 1.0, 64, 128);
    MaterialSettings material = test::material_of(MaterialKind::coated_conductor, white.file());
    material.coat_ior = 1.0; // no reflection and no refraction: two passes of the thickness are left
    material.coat_bump = 0.0;
    material.coat_bump_width = 2.0;
    material.coat_thickness = 0.02;
    const BakeScene scene(ball, material);
    const SpectralLight light(test::even_light(), 1.0);
    SceneView view = test::front_view(ball, 33);
    BakeSettings settings{.samples = 64};
    const SpectralFrame frame = test::baked(scene, light, view, settings);
    const std::size_t middle = 16 * 33 + 16;
    for (std::size_t bin = 0; bin < spectral_bins; ++bin) {
        const double white_light = light_basis()[0][bin] + light_basis()[1][bin] + light_basis()[2][bin];
        const double expected = white_light * std::exp(-2.0 * absorbance_of(material.coat_absorbance)[bin]);
        CHECK(double{frame.radiance[middle * spectral_bins + bin]} == Approx(expected).epsilon(0.003));
    }
}
