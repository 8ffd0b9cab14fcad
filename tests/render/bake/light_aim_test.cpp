/// Paths that are aimed at compact sources of light.
#include "render/bake/light_aim.h"

#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "experiment/base/random.h"
#include "render/bake/material_model.h"
#include "tests/render/bake/bake_support.h"

using namespace overt;

namespace {

constexpr double pi = std::numbers::pi;

LightProbe random_probe(glm::ivec2 size) {
    RandomStream random(12, "texels");
    LightProbe probe{LinearImage(size), 0};
    for (glm::vec4& pixel : probe.radiance.pixels)
        pixel = glm::vec4(static_cast<float>(std::pow(random.uniform(), 6.0)), 0.02f, 0.1f, 1.0f);
    return probe;
}

/// Even light of `around`, and in some texels about azimuth 40 degrees and elevation 35 of the probe a
/// source.
LightProbe probe_with_source(float around, float source) {
    LightProbe probe{LinearImage({512, 256}), 0};
    for (glm::vec4& pixel : probe.radiance.pixels)
        pixel = glm::vec4(glm::vec3(around), 1.0f);
    for (int y = 77; y < 80; ++y) {
        for (int x = 199; x < 202; ++x)
            probe.radiance.at(x, y) = glm::vec4(source, 0.8f * source, 0.5f * source, 1.0f);
    }
    return probe;
}

glm::dvec3 direction_of_texel(glm::dvec2 place, glm::ivec2 size) {
    const double azimuth = 2.0 * pi * (place.x / size.x - 0.5), from_zenith = pi * place.y / size.y;
    return {std::sin(from_zenith) * std::sin(azimuth), std::sin(from_zenith) * std::cos(azimuth),
            std::cos(from_zenith)};
}

/// Mean X, Y and Z over a figure, and each of them again with another seed.
std::vector<glm::dvec3> mean_light(const BakeScene& scene, const SpectralLight& light, const SceneView& view,
                                   int samples, int seeds) {
    std::vector<glm::dvec3> means;
    for (int seed = 0; seed < seeds; ++seed) {
        BakeSettings settings{.samples = samples};
        settings.seed = static_cast<std::uint64_t>(seed);
        const SpectralFrame frame = test::baked(scene, light, view, settings, {30.0});
        const LinearImage picture = to_xyz(frame);
        glm::dvec3 sum(0.0);
        double weight = 0.0;
        for (const glm::vec4& pixel : picture.pixels) {
            sum += static_cast<double>(pixel.a) * glm::dvec3(pixel);
            weight += static_cast<double>(pixel.a);
        }
        means.push_back(sum / weight);
    }
    return means;
}

struct MeanAndError {
    double mean = 0.0, error = 0.0; ///< standard error
};

MeanAndError summary(const std::vector<glm::dvec3>& values, int axis) {
    MeanAndError result;
    const auto count = static_cast<double>(values.size());
    for (const glm::dvec3& value : values)
        result.mean += value[axis] / count;
    for (const glm::dvec3& value : values)
        result.error += std::pow(value[axis] - result.mean, 2.0) / (count * (count - 1.0));
    result.error = std::sqrt(result.error);
    return result;
}

} // namespace

TEST_CASE("the density of aimed directions adds to one over the sphere, and they are drawn with it",
          "[unit]") {
    // The last is of cells of three texels each, the last of which stand out beyond the picture.
    for (const glm::ivec2 size : {glm::ivec2(64, 32), {512, 256}, {2050, 1025}}) {
        const LightProbe probe = random_probe(size);
        const LightAim aim(probe);
        const float turn = 0.3f;
        // Middles of a grid that has whole cells.
        const glm::ivec2 grid = size.x > 2000 ? size : glm::ivec2(1024, 512);
        double whole = 0.0, height = 0.0, squares = 0.0;
        for (int y = 0; y < grid.y; ++y) {
            const double band = std::cos(pi * y / grid.y) - std::cos(pi * (y + 1) / grid.y);
            for (int x = 0; x < grid.x; ++x) {
                const glm::dvec3 direction = direction_of_texel({x + 0.5, y + 0.5}, grid);
                const double density = aim.density(glm::vec3(direction), turn);
                const double share = density * band * 2.0 * pi / grid.x;
                whole += share;
                height += share * direction.z;
                squares += share * density;
            }
        }
        CHECK(whole == Approx(1.0).epsilon(1e-3));
        double drawn_height = 0.0, drawn_density = 0.0, inverse = 0.0;
        constexpr int side = 400;
        for (int i = 0; i < side * side; ++i) {
            const glm::vec2 place((glm::vec2(i % side, i / side) + 0.5f) / static_cast<float>(side));
            const glm::vec3 direction = aim.direction(place, turn);
            REQUIRE(glm::length(direction) == Approx(1.0).epsilon(1e-5));
            const double density = aim.density(direction, turn);
            REQUIRE(density > 0.0);
            drawn_height += static_cast<double>(direction.z) / (side * side);
            drawn_density += density / (side * side);
            inverse += 1.0 / density / (side * side);
        }
        CHECK(drawn_height == Approx(height).margin(0.01));
        CHECK(drawn_density == Approx(squares).epsilon(0.05));
        CHECK(inverse == Approx(4.0 * pi).epsilon(0.05)); // nowhere 0: all directions come up
    }
}

TEST_CASE("paths are aimed in the gallery, and not under an overcast or an even sky", "[unit]") {
    CHECK(SpectralLight(LightSettings{}).aim() == nullptr);
    CHECK(SpectralLight(test::even_light(), 1.0).aim() == nullptr);
    LightSettings gallery;
    gallery.probe = "gallery";
    CHECK(SpectralLight(gallery).aim() != nullptr);
    CHECK(LightAim(test::even_light()).unevenness() == Approx(1.0));
}

TEST_CASE("a rough surface tells the density with which it scatters", "[unit]") {
    const Mesh ball = test::ball({0, 0, 0}, 1.0, 12, 24);
    for (const double alpha : {0.13, 0.5}) {
        MaterialSettings material = test::material_of(MaterialKind::rough_conductor);
        material.roughness = alpha;
        const BakeScene scene(ball, material);
        for (const double angle : {0.0, 0.8, 1.3}) {
            const SurfaceEvent event{glm::vec3(std::sin(angle), 0.0, std::cos(angle)), {0.0f, 0.0f, 1.0f}};
            // Over directions above the surface; what is sent below it ends the path.
            glm::dvec3 expected(0.0), drawn(0.0);
            double told = 0.0, above = 0.0;
            constexpr int rows = 600, columns = 1200;
            for (int row = 0; row < rows; ++row) {
                for (int column = 0; column < columns; ++column) {
                    const double z = (row + 0.5) / rows, around = 2.0 * pi * (column + 0.5) / columns;
                    const double sine = std::sqrt(1.0 - z * z);
                    const glm::dvec3 direction(sine * std::cos(around), sine * std::sin(around), z);
                    const double share = double{scene.model().density(scene, event, glm::vec3(direction))} *
                                         2.0 * pi / (rows * columns);
                    told += share;
                    expected += share * direction;
                }
            }
            constexpr std::uint32_t samples = 65536;
            for (std::uint32_t sample = 0; sample < samples; ++sample) {
                SampleSequence sequence(1, {3, 4}, sample);
                Bins carried = Bins::filled(1.0f);
                const glm::vec3 out = scene.model().scatter(scene, event, sequence, carried);
                if (out == glm::vec3(0.0f))
                    continue;
                above += 1.0 / samples;
                drawn += glm::dvec3(out) / double{samples};
                if (sample % 1024 == 0) {
                    Bins taken = Bins::filled(1.0f);
                    scene.model().take(scene, event, out, taken);
                    CHECK(taken.value[7] == Approx(carried.value[7]).epsilon(1e-4));
                }
            }
            CAPTURE(alpha, angle);
            CHECK(told == Approx(above).margin(0.003));
            CHECK(glm::length(expected - drawn) < 0.004);
        }
    }
}

TEST_CASE("a matt surface under a small source is as bright as its irradiance says", "[unit]") {
    // The front of a box, seen head-on, whose normal is -y; the source is behind the camera, to its right.
    LightProbe probe = probe_with_source(0.0f, 0.0f);
    glm::dvec3 irradiance(0.0);
    const glm::ivec2 size = probe.radiance.size_px;
    for (int y = 80; y < 84; ++y) {
        for (int x = 60; x < 64; ++x) {
            const glm::dvec3 light(4000.0, 3000.0, 1500.0);
            probe.radiance.at(x, y) = glm::vec4(glm::vec3(light), 1.0f);
            const double angle =
                2.0 * pi / size.x * (std::cos(pi * y / size.y) - std::cos(pi * (y + 1) / size.y));
            irradiance += light * angle * -direction_of_texel({x + 0.5, y + 0.5}, size).y;
        }
    }
    MaterialSettings material = test::material_of(MaterialKind::diffuse);
    material.reflectance = glm::dvec3(0.5, 0.5, 0.5);
    const Mesh box = test::box({-1, -0.1, -1}, {1, 0.1, 1});
    const BakeScene scene(box, material);
    const SpectralLight light(probe, 1.0);
    REQUIRE(light.aim() != nullptr);
    const LinearImage picture =
        to_rec709(test::baked(scene, light, test::front_view(box, 24), {.samples = 64}));
    glm::dvec3 mean(0.0);
    for (int y = 10; y < 14; ++y) {
        for (int x = 10; x < 14; ++x)
            mean += glm::dvec3(picture.at(x, y)) / 16.0;
    }
    const glm::dvec3 expected = 0.5 / pi * irradiance;
    for (int channel = 0; channel < 3; ++channel)
        CHECK(mean[channel] == Approx(expected[channel]).epsilon(0.01));
}

TEST_CASE("aiming changes the noise of a picture and not its light", "[unit]") {
    const SpectralLight aimed(probe_with_source(0.3f, 2000.0f), 1.0);
    SpectralLight by_chance = aimed;
    by_chance.aim_nowhere();
    REQUIRE(aimed.aim() != nullptr);
    for (const MaterialKind kind : {MaterialKind::diffuse, MaterialKind::rough_conductor}) {
        MaterialSettings material = test::material_of(kind);
        material.roughness = 0.3;
        const BakeScene scene(test::bust(), material);
        const SceneView view = test::front_view(test::bust(), 20);
        const auto with = mean_light(scene, aimed, view, 64, 16),
                   without = mean_light(scene, by_chance, view, 256, 48);
        for (int axis = 0; axis < 3; ++axis) {
            const MeanAndError a = summary(with, axis), b = summary(without, axis);
            CAPTURE(row_of(kind).name, axis, a.mean, a.error, b.mean, b.error);
            CHECK(std::abs(a.mean - b.mean) < 4.0 * std::sqrt(a.error * a.error + b.error * b.error));
            // Of a sixteenth of the samples: the error of one of them is at least twice as small.
            const double variance_ratio = std::pow(b.error / a.error, 2.0) * 48.0 * 256.0 / (16.0 * 64.0);
            CHECK(variance_ratio > 4.0);
        }
    }
}

TEST_CASE("a frame in the gallery is the same whoever computes it, and surfaces without chance are not aimed",
          "[unit]") {
    LightSettings settings;
    settings.probe = "gallery";
    const SpectralLight gallery(settings);
    SpectralLight by_chance = gallery;
    by_chance.aim_nowhere();
    const SceneView view = test::front_view(test::bust(), 32);
    for (const MaterialKind kind : {MaterialKind::rough_conductor, MaterialKind::smooth_conductor}) {
        const BakeScene scene(test::bust(), test::material_of(kind));
        BakeSettings baking{.samples = 16};
        baking.most_threads = 1;
        const SpectralFrame alone = test::baked(scene, gallery, view, baking);
        baking.most_threads = 2;
        CHECK(alone.radiance == test::baked(scene, gallery, view, baking).radiance);
        CHECK((alone.radiance == test::baked(scene, by_chance, view, baking).radiance) ==
              (kind == MaterialKind::smooth_conductor));
    }
}
