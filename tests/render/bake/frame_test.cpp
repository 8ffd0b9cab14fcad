#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "experiment/base/error.h"
#include "render/bake/eye_rays.h"
#include "render/bake/film.h"
#include "render/bake/pixel_sampling.h"
#include "tests/render/bake/bake_support.h"

using namespace overt;

namespace {

const SpectralLight& sky() {
    static const SpectralLight light{LightSettings{}};
    return light;
}

BakeScene rough_bust() { return {test::bust(), test::material_of(MaterialKind::rough_conductor)}; }

} // namespace

TEST_CASE("a frame is the same bit for bit on one processor and on several", "[unit]") {
    for (const MaterialKind kind : {MaterialKind::rough_conductor, MaterialKind::coated_conductor}) {
        MaterialSettings material = test::material_of(kind);
        material.coat_bump_width = 0.2;
        const BakeScene one(test::bust(), material), other(test::bust(), material);
        const SceneView view = test::front_view(test::bust(), 40);
        BakeSettings settings{.samples = 32, .target_error_de = 1.0};
        settings.most_threads = 1;
        const SpectralFrame alone = test::baked(one, sky(), view, settings, {12.0});
        settings.most_threads = 2;
        const SpectralFrame together = test::baked(other, sky(), view, settings, {12.0});
        CHECK(alone.radiance == together.radiance);
        CHECK(alone.alpha == together.alpha);
        CHECK(alone.samples == together.samples);
        CHECK(alone.rays == together.rays);
    }
}

namespace {

/// Mean distance of two pictures' light over their mean light.
double difference(const SpectralFrame& a, const SpectralFrame& b) {
    const LinearImage one = to_rec709(a), other = to_rec709(b);
    double between = 0.0, all = 0.0;
    for (std::size_t i = 0; i < one.pixels.size(); ++i) {
        between += glm::length(glm::dvec3(one.pixels[i] - other.pixels[i]));
        all += glm::length(glm::dvec3(one.pixels[i]));
    }
    return between / all;
}

} // namespace

TEST_CASE("a ball on a turntable looks the same however it is turned, for the light stays", "[unit]") {
    // A quarter turn brings its vertices onto each other.
    const Mesh ball = test::ball({0.0, 0.0, 0.0}, 50.0);
    const SceneView view = test::front_view(ball, 40);
    LightSettings settings;
    settings.probe = "gallery";
    const SpectralLight gallery(settings);
    settings.rotation_deg = 90.0;
    const SpectralLight turned_light(settings);
    for (const MaterialKindRow& row : material_kinds) {
        CAPTURE(row.name);
        MaterialSettings material = test::material_of(row.kind);
        material.coat_bump = 0.0;                     // bumps turn with the ball
        material.scattering_per_mm = {0.0, 0.0, 0.0}; // and what it turns light by is noise
        const BakeScene scene(ball, material);
        const BakeSettings baking{.samples = 64};
        const SpectralFrame still = test::baked(scene, gallery, view, baking);
        const double turned = difference(still, test::baked(scene, gallery, view, baking, {90.0})),
                     other_light = difference(still, test::baked(scene, turned_light, view, baking));
        CHECK(turned < 0.2 * other_light);
    }
}

TEST_CASE("a band of rows baked by itself is the same as in the whole frame", "[unit]") {
    const BakeScene scene = rough_bust();
    const SceneView view = test::front_view(test::bust(), 40);
    const std::vector<std::uint8_t> covered = covered_pixels(scene, view, {0.0});
    std::vector<std::uint8_t> band = covered;
    for (std::size_t pixel = 0; pixel < band.size(); ++pixel) {
        if (pixel / 40 < 15 || pixel / 40 >= 25)
            band[pixel] = 0;
    }
    const BakeSettings settings{.samples = 8};
    const SpectralFrame whole = bake_frame(scene, sky(), view, {0.0}, covered, settings);
    const SpectralFrame part = bake_frame(scene, sky(), view, {0.0}, band, settings);
    for (std::size_t value = std::size_t{15} * 40 * spectral_bins;
         value < std::size_t{25} * 40 * spectral_bins; ++value)
        REQUIRE(whole.radiance[value] == part.radiance[value]);
    CHECK(std::all_of(part.alpha.begin(), part.alpha.begin() + 14 * 40,
                      [](float alpha) { return alpha == 0.0f; }));
}

TEST_CASE("alpha is at least one half exactly where the map has a triangle", "[unit]") {
    for (const int step : {1, 2}) {
        const BakeScene scene = rough_bust();
        const SceneView view = test::front_view(test::bust(), 41);
        const std::vector<std::uint8_t> covered = covered_pixels(scene, view, {20.0});
        BakeSettings settings{.samples = 4};
        settings.pixel_step = step;
        const SpectralFrame frame = bake_frame(scene, sky(), view, {20.0}, covered, settings);
        const LinearImage picture = to_rec709(frame);
        for (std::size_t pixel = 0; pixel < covered.size(); ++pixel) {
            REQUIRE((frame.alpha[pixel] >= 0.5f) == (covered[pixel] != 0));
            REQUIRE(frame.alpha[pixel] <= 1.00001f);
            // What is seen has light.
            if (frame.alpha[pixel] > 0.0f)
                REQUIRE(picture.pixels[pixel].y > 0.0f);
        }
    }
}

TEST_CASE("a coat has the silhouette of what lies below it", "[unit]") {
    const SceneView view = test::front_view(test::bust(), 40);
    MaterialSettings coated = test::material_of(MaterialKind::coated_conductor);
    coated.coat_bump_width = 0.2;
    coated.coat_thickness = 0.05;
    const BakeSettings settings{.samples = 16};
    const SpectralFrame bare = test::baked(rough_bust(), sky(), view, settings);
    const SpectralFrame lacquered = test::baked(BakeScene(test::bust(), coated), sky(), view, settings);
    CHECK(bare.alpha == lacquered.alpha);
}

TEST_CASE("with a target of error pixels stop when they reach it, and the frame does", "[unit]") {
    const BakeScene scene = rough_bust();
    const SceneView view = test::front_view(test::bust(), 40);
    BakeSettings settings{.samples = 1024};
    settings.seed = 7;
    const LinearImage reference = to_xyz(test::baked(scene, sky(), view, settings));
    settings.seed = 1;
    settings.target_error_de = 2.0;
    const SpectralFrame frame = test::baked(scene, sky(), view, settings);
    const LinearImage picture = to_xyz(frame);
    const auto lab = [](glm::vec4 xyz) { return lab_of_xyz(glm::dvec3(xyz)); };
    double sum = 0.0, samples = 0.0;
    int lit = 0;
    for (std::size_t pixel = 0; pixel < picture.pixels.size(); ++pixel) {
        if (frame.alpha[pixel] < 0.9f)
            continue;
        ++lit;
        sum += glm::distance(lab(picture.pixels[pixel]), lab(reference.pixels[pixel]));
        samples += frame.samples[pixel];
    }
    CHECK(sum / lit < 2.0);
    CHECK(samples / lit < 512.0);
    CHECK(samples / lit > 16.0);
    CHECK(frame.error_de.size() == frame.alpha.size());
}

TEST_CASE("the error that a frame states is the error it has", "[unit]") {
    // A target that no pixel reaches: each gets all its samples, and its error is estimated in the last
    // round.
    const BakeScene scene = rough_bust();
    const SceneView view = test::front_view(test::bust(), 40);
    BakeSettings settings{.samples = 4096};
    settings.seed = 7;
    const LinearImage reference = to_xyz(test::baked(scene, sky(), view, settings));
    const auto lab = [](glm::vec4 xyz) { return lab_of_xyz(glm::dvec3(xyz)); };
    double is_squared = 0.0, said_squared = 0.0;
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
        BakeSettings few{.samples = 32};
        few.seed = seed;
        few.target_error_de = 1e-6;
        const SpectralFrame frame = test::baked(scene, sky(), view, few);
        const LinearImage picture = to_xyz(frame);
        for (std::size_t pixel = 0; pixel < picture.pixels.size(); ++pixel) {
            if (frame.alpha[pixel] < 0.999f)
                continue;
            is_squared +=
                std::pow(glm::distance(lab(picture.pixels[pixel]), lab(reference.pixels[pixel])), 2.0);
            said_squared += std::pow(static_cast<double>(frame.error_de[pixel]), 2.0);
        }
    }
    // Samples that are spread by plan err less than independent ones, as which the estimate takes them.
    const double ratio = std::sqrt(said_squared / is_squared);
    CAPTURE(ratio);
    CHECK(ratio > 0.7);
    CHECK(ratio < 1.6);
}

TEST_CASE("the samples of a pixel are spread as its filter says", "[unit]") {
    const auto deviation = [](PixelFilter filter, double width) {
        const PixelSampling sampling(filter, width);
        double sum = 0.0, squares = 0.0;
        constexpr int count = 20000;
        for (int i = 0; i < count; ++i) {
            const float place = (static_cast<float>(i) + 0.5f) / count;
            const double x = static_cast<double>(sampling.offset({place, 0.5f}).x);
            CHECK(std::abs(x) <= 0.5 * width + 1e-6);
            sum += x / count;
            squares += x * x / count;
        }
        CHECK(std::abs(sum) < 1e-4);
        return std::sqrt(squares);
    };
    CHECK(deviation(PixelFilter::box, 1.0) == Approx(1.0 / std::sqrt(12.0)).epsilon(1e-3));
    CHECK(deviation(PixelFilter::gaussian, 3.0) == Approx(0.98658 * 0.5).epsilon(2e-3)); // cut off at 3 sigma
    // Second moment of the window's cosine series: width^2 (1/12 + sum a_k (-1)^k / (2 pi^2 k^2) / a_0 …).
    const double pi_squared = 9.8696044;
    const double moment =
        1.0 / 12.0 + (-0.48829 + 0.14128 / 4.0 - 0.01168 / 9.0) / (2.0 * pi_squared * 0.35875);
    CHECK(deviation(PixelFilter::blackman_harris, 2.0) == Approx(2.0 * std::sqrt(moment)).epsilon(2e-3));
}

TEST_CASE("eye rays are those of the view", "[unit]") {
    const SceneView view = test::front_view(test::bust(), 64);
    const EyeRays eye(view, {17.0}, view.bounds.centre(), 3.0);
    for (const glm::dvec2 place : {glm::dvec2(0.5, 0.5), {63.2, 11.0}, {32.0, 32.0}}) {
        const Ray expected = to_object(view.view.ray_through(place), view.pose_at({17.0}));
        const PathRay ray = eye.through(place);
        CHECK(glm::length(glm::dvec3(ray.direction) - expected.direction) < 1e-6);
        const glm::dvec3 from = glm::dvec3(ray.origin) + view.bounds.centre() - expected.origin;
        CHECK(glm::length(glm::cross(from, expected.direction)) < 1e-5);
    }
}

TEST_CASE("impossible settings of a bake are refused, and a stopped frame is not complete", "[unit]") {
    const BakeScene scene = rough_bust();
    const SceneView view = test::front_view(test::bust(), 16);
    CHECK_THROWS_AS(test::baked(scene, sky(), view, {.samples = 0}), InputError);
    CHECK_THROWS_AS(test::baked(scene, sky(), view, {.samples = 4, .filter_width_px = 9.0}), InputError);
    double furthest = 0.0;
    const auto covered = covered_pixels(scene, view, {0.0});
    const BakeProgress stop = [&](double share) {
        furthest = share;
        return false;
    };
    CHECK_FALSE(bake_frame(scene, sky(), view, {0.0}, covered, {.samples = 4}, stop).is_complete);
    CHECK(furthest > 0.0);
    CHECK(furthest <= 1.0);
}

TEST_CASE("a pixel of a preview stands for the middle of its four pixels of the picture", "[unit]") {
    // Light that rises by 1 from pixel to pixel of the film: in the picture it must rise evenly, and be the
    // film's own where the middles meet, a quarter of a film's pixel to each side of it.
    constexpr int size = 16;
    const std::vector<std::uint8_t> covered(size * size, 1);
    Film film({size, size}, 2, covered);
    REQUIRE(film.count() == size * size / 4);
    for (std::size_t i = 0; i < film.count(); ++i) {
        film.pixel(i).samples = film.pixel(i).met = 1;
        film.pixel(i).light = Bins::filled(static_cast<float>(1 + film.place(i).x + 10 * film.place(i).y));
    }
    const SpectralFrame frame = film.develop(covered);
    for (int y = 1; y < size - 1; ++y) {
        for (int x = 1; x < size - 1; ++x) {
            const auto pixel = static_cast<std::size_t>(y * size + x);
            REQUIRE(frame.radiance[pixel * spectral_bins] ==
                    Approx(1.0 + (x + 0.5) / 2.0 - 0.5 + 10.0 * ((y + 0.5) / 2.0 - 0.5)).epsilon(1e-5));
            REQUIRE(frame.alpha[pixel] == Approx(1.0));
        }
    }
}
