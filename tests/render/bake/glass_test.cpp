#include <numbers>

#include <catch2/catch.hpp>

#include "render/bake/further_laws.h"
#include "render/bake/glass.h"
#include "render/bake/microfacets.h"
#include "tests/render/bake/bake_support.h"

using namespace overt;

namespace {

MaterialSettings glass_of(double ior) {
    MaterialSettings material = test::material_of(MaterialKind::glass);
    material.ior = ior;
    return material;
}

glm::vec3 at_cosine(double cosine) {
    return glm::vec3(glm::dvec3(std::sqrt(1.0 - cosine * cosine), 0.0, cosine));
}

constexpr glm::vec3 straight_up(0.0f, 0.0f, 1.0f);

} // namespace

TEST_CASE("films, brushed metal and rough glass keep to the numbers of others", "[unit]") {
    for (const SurfaceLaw& law : further_laws()) {
        CAPTURE(law.what, law.ours, law.known);
        CHECK(law.holds());
    }
    CHECK(Glass(glass_of(1.5168)).index(0) == 1.5168f); // without an Abbe number one for all
}

TEST_CASE("polished glass mirrors by Fresnel and bends by Snell, in and out", "[unit]") {
    const Glass glass(glass_of(1.5));
    SampleSequence sequence(1, {0, 0}, 0);
    for (const auto& [cosine, reflected] :
         {std::pair{1.0, 0.04}, {0.8, 0.043895}, {0.5, 0.089187}, {0.2, 0.338894}, {0.05, 0.752131}}) {
        const GlassWay back =
            glass.meet(at_cosine(cosine), straight_up, straight_up, true, -1, GlassTurn::mirrored, sequence);
        const GlassWay through = glass.meet(at_cosine(cosine), straight_up, straight_up, true, -1,
                                            GlassTurn::let_through, sequence);
        CHECK_FALSE(back.goes_through);
        CHECK(through.goes_through);
        CHECK(back.carried.value[7] == Approx(reflected).margin(2e-6));
        CHECK(through.carried.value[7] == Approx(1.0 - reflected).margin(2e-6));
        const double sine = std::sqrt(1.0 - cosine * cosine);
        CHECK(through.direction.x == Approx(-sine / 1.5).margin(1e-6));
        CHECK(through.direction.z < 0.0f);
        CHECK(back.direction.x == Approx(-sine).margin(1e-6));
        // Back the same way.
        const GlassWay out = glass.meet(through.direction, -straight_up, -straight_up, false, -1,
                                        GlassTurn::mirrored, sequence);
        CHECK(out.carried.value[7] == Approx(reflected).margin(1e-5));
        // By chance as often as it has light.
        constexpr std::uint32_t paths = 4096;
        double mirrored = 0.0;
        for (std::uint32_t path = 0; path < paths; ++path) {
            SampleSequence numbers(2, {1, 0}, path);
            const GlassWay way = glass.meet(at_cosine(cosine), straight_up, straight_up, true, -1,
                                            GlassTurn::by_chance, numbers);
            CHECK(way.carried.value[7] == 1.0f);
            mirrored += way.goes_through ? 0.0 : 1.0 / paths;
        }
        CHECK(mirrored == Approx(reflected).margin(2e-3));
    }
    const auto from_within = [&](double cosine, GlassTurn turn) {
        return glass.meet(at_cosine(cosine), straight_up, straight_up, false, -1, turn, sequence);
    };
    CHECK(from_within(0.8, GlassTurn::mirrored).carried.value[3] == Approx(0.114141).margin(2e-6));
    CHECK(from_within(0.5, GlassTurn::mirrored).carried.value[3] == 1.0f);
    CHECK(from_within(0.5, GlassTurn::let_through).carried.largest() == 0.0f);
    CHECK_FALSE(from_within(0.5, GlassTurn::by_chance).goes_through);
}

TEST_CASE("rough glass with an Abbe number keeps all light, each colour its own share", "[unit]") {
    MaterialSettings flint = glass_of(1.7);
    flint.abbe = 25.0;
    flint.roughness = 0.5;
    const Glass glass(flint);
    constexpr std::uint32_t paths = 31 * 1024;
    // Mirrored and let through, of each band; by both turns at first, and by chance alone.
    const auto shares_of = [&](const Glass& of, std::initializer_list<GlassTurn> turns, std::size_t bin) {
        glm::dvec2 shares(0.0);
        for (std::uint32_t path = 0; path < paths; ++path)
            for (const GlassTurn turn : turns) {
                SampleSequence numbers(5, {3, 1}, path);
                const GlassWay way =
                    of.meet(at_cosine(0.4), straight_up, straight_up, true, -1, turn, numbers);
                CHECK((way.band >= 0 || !way.goes_through));
                shares[way.goes_through ? 1 : 0] += static_cast<double>(way.carried.value[bin]) / paths;
            }
        return shares;
    };
    for (const std::size_t bin : {std::size_t{0}, std::size_t{30}}) {
        MaterialSettings alone = glass_of(static_cast<double>(glass.index(static_cast<int>(bin))));
        alone.roughness = 0.5;
        const Glass of_one(alone);
        glm::dvec2 known(0.0);
        for (std::uint32_t path = 0; path < paths; ++path) {
            SampleSequence numbers(6, {3, 2}, path);
            known[of_one.meet(at_cosine(0.4), straight_up, straight_up, true, -1, GlassTurn::by_chance,
                              numbers)
                          .goes_through
                      ? 1
                      : 0] += 1.0 / paths;
        }
        const glm::dvec2 both = shares_of(glass, {GlassTurn::mirrored, GlassTurn::let_through}, bin),
                         by_chance = shares_of(glass, {GlassTurn::by_chance}, bin);
        CHECK(both.x == Approx(known.x).margin(0.005));
        CHECK(both.y == Approx(known.y).margin(0.06)); // one path in 31 has this colour
        CHECK(by_chance.x == Approx(known.x).margin(0.01));
        CHECK(by_chance.y == Approx(known.y).margin(0.1));
    }
}

TEST_CASE("a ball of rough glass in even light is not to be seen", "[unit]") {
    MaterialSettings frosted = glass_of(1.5);
    frosted.roughness = 0.6;
    const Mesh ball = test::ball({0.0, 0.0, 0.0}, 1.0, 96, 192);
    const LinearImage lit =
        to_rec709(test::baked(BakeScene(ball, frosted), SpectralLight(test::even_light(), 1.0),
                              test::front_view(ball, 12), {.samples = 64}));
    double light = 0.0, covered = 0.0;
    for (const glm::vec4& pixel : lit.pixels) {
        light += static_cast<double>(pixel.g);
        covered += static_cast<double>(pixel.a);
    }
    CHECK(light / covered == Approx(1.0).margin(0.01));
}

TEST_CASE("a ball of glass shows what Snell says lies behind it, upside down", "[unit]") {
    // Parallel to the axis at 0.2 of the radius, index 1.5168: it leaves at x = 0.06308 (an independent
    // reckoning), and from there turned by twice the difference of the angles.
    const Mesh ball = test::ball({0.0, 0.0, 0.0}, 1.0, 192, 384);
    LightProbe probe = test::even_light(glm::vec3(0.0f));
    probe.radiance = LinearImage({512, 256});
    for (int y = 0; y < 256; ++y)
        for (int x = 0; x < 512; ++x)
            probe.radiance.at(x, y) = glm::vec4(static_cast<float>(x) / 512.0f, 0.0f, 0.0f, 1.0f);
    SceneView view = test::front_view(ball, 31);
    view.view.camera.position = {0.0, -1000.0, 0.0};
    view.view.camera.vertical_fov = to_degrees({2.0 * std::atan(1.1 / 1000.0)});
    const BakeScene scene(ball, glass_of(1.5168));
    const LinearImage picture =
        to_rec709(test::baked(scene, SpectralLight(probe, 1.0), view, {.samples = 64}));
    const double px = 2.2 / 31.0;
    for (const int column : {18, 21}) {
        const double b = (column + 0.5) * px - 1.1, in = std::asin(b), inside = std::asin(b / 1.5168);
        // Twice bent towards the axis, it goes on to the other side.
        const double leaves = -2.0 * (in - inside);
        const double azimuth =
            std::atan2(std::sin(leaves), std::cos(leaves)) / (2.0 * std::numbers::pi) + 0.5;
        // Of what goes through: some 8 % is mirrored, of which the one surface shows the other side.
        CAPTURE(column, b);
        const double seen = static_cast<double>(picture.at(column, 15).r);
        CHECK(seen == Approx(azimuth).margin(0.04));
        CHECK(static_cast<double>(picture.at(30 - column, 15).r) > seen); // mirrored about the middle
    }
}

TEST_CASE("colours part in glass with an Abbe number, and stay together in the mean", "[unit]") {
    const Mesh ball = test::ball({0.0, 0.0, 0.0}, 1.0, 96, 192);
    MaterialSettings flint = glass_of(1.7);
    const SpectralLight even(test::even_light(), 1.0);
    const SceneView view = test::front_view(ball, 16);
    const auto mean_of = [&](const MaterialSettings& material) {
        const LinearImage lit =
            to_rec709(test::baked(BakeScene(ball, material), even, view, {.samples = 248}));
        glm::dvec3 light(0.0);
        double covered = 0.0;
        for (const glm::vec4& pixel : lit.pixels) {
            light += glm::dvec3(pixel);
            covered += static_cast<double>(pixel.a);
        }
        return light / covered;
    };
    flint.abbe = 25.0;
    const glm::dvec3 parted = mean_of(flint);
    for (int channel = 0; channel < 3; ++channel)
        CHECK(parted[channel] == Approx(1.0).margin(0.03));
    // What is absorbed is by Beer's law: of a ball of half the height 1, in the middle, over twice that.
    MaterialSettings wine = glass_of(1.0001 + 0.0099);
    wine.absorbance = {0.5, 0.5, 0.5};
    SceneView middle = view;
    middle.view.camera.vertical_fov.value /= 50.0;
    const LinearImage seen = to_rec709(test::baked(BakeScene(ball, wine), even, middle, {.samples = 16}));
    CHECK(static_cast<double>(seen.at(8, 8).g) == Approx(std::exp(-1.0)).epsilon(0.01));
}

TEST_CASE("glass asks for a closed surface whose fronts face out", "[unit]") {
    Mesh open = test::ball({0.0, 0.0, 0.0}, 1.0);
    open.triangles.resize(open.triangles.size() / 2);
    CHECK_THROWS_WITH(BakeScene(open, glass_of(1.5)), Catch::Contains("glass needs a closed surface"));
}
