#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "experiment/base/random.h"
#include "render/bake/microfacets.h"

using namespace overt;

namespace {

glm::vec3 direction_at(double cosine, double azimuth) {
    const double sine = std::sqrt(1.0 - cosine * cosine);
    return {static_cast<float>(sine * std::cos(azimuth)), static_cast<float>(sine * std::sin(azimuth)),
            static_cast<float>(cosine)};
}

/// Integral over the hemisphere, by the midpoint rule in (tan of the half angle, azimuth), which is fine
/// where GGX is high.
template <class Value> double over_hemisphere(const Value& value) {
    constexpr int rings = 1200, sectors = 240;
    double sum = 0.0;
    for (int ring = 0; ring < rings; ++ring) {
        // cosine = 1 - s^2 puts half the rings within 40 degrees of the pole.
        const double s = (ring + 0.5) / rings, cosine = 1.0 - s * s, weight = 2.0 * s / rings;
        for (int sector = 0; sector < sectors; ++sector) {
            const double azimuth = 2.0 * std::numbers::pi * (sector + 0.5) / sectors;
            sum += weight * 2.0 * std::numbers::pi / sectors * value(direction_at(cosine, azimuth));
        }
    }
    return sum;
}

} // namespace

TEST_CASE("the micro-mirrors of GGX make up a flat square metre seen from above", "[unit]") {
    for (const float alpha : {0.13f, 0.4f, 1.0f}) {
        CHECK(over_hemisphere([&](glm::vec3 m) { return double{ggx_density(m, alpha)} * double{m.z}; }) ==
              Approx(1.0).epsilon(1e-3));
    }
}

TEST_CASE("the visible ones, seen from any side, have the area of the surface", "[unit]") {
    for (const float alpha : {0.13f, 0.5f}) {
        for (const double cosine : {1.0, 0.6, 0.2}) {
            const glm::vec3 eye = direction_at(cosine, 0.4);
            const double visible = over_hemisphere([&](glm::vec3 m) {
                return double{ggx_visible_share(eye, alpha)} * double{ggx_density(m, alpha)} *
                       std::max(0.0, static_cast<double>(glm::dot(eye, m)));
            });
            CHECK(visible == Approx(cosine).epsilon(2e-3));
        }
    }
}

TEST_CASE("visible normals are drawn with their density: mean and spread agree with the integral", "[unit]") {
    for (const float alpha : {0.13f, 0.5f}) {
        for (const double cosine : {1.0, 0.5, 0.15}) {
            const glm::vec3 eye = direction_at(cosine, 2.1);
            RandomStream random(4, "visible normals");
            glm::dvec3 mean(0.0), squares(0.0);
            constexpr int count = 40000;
            for (int i = 0; i < count; ++i) {
                const glm::vec3 m = ggx_visible_normal(
                    eye, alpha, {static_cast<float>(random.uniform()), static_cast<float>(random.uniform())});
                mean += glm::dvec3(m) / double{count};
                squares += glm::dvec3(m) * glm::dvec3(m) / double{count};
            }
            for (int axis = 0; axis < 3; ++axis) {
                const auto expected = [&](auto power) {
                    return over_hemisphere([&](glm::vec3 m) {
                               return power(double{m[axis]}) * double{ggx_density(m, alpha)} *
                                      std::max(0.0, static_cast<double>(glm::dot(eye, m)));
                           }) *
                           double{ggx_visible_share(eye, alpha)} / cosine;
                };
                CHECK(mean[axis] == Approx(expected([](double x) { return x; })).margin(0.008));
                CHECK(squares[axis] == Approx(expected([](double x) { return x * x; })).margin(0.008));
            }
        }
    }
}

TEST_CASE("diffuse directions lie as densely as their cosine", "[unit]") {
    RandomStream random(2, "diffuse directions");
    constexpr int count = 40000;
    glm::dvec3 mean(0.0), squares(0.0);
    for (int i = 0; i < count; ++i) {
        const glm::vec3 direction =
            cosine_direction({static_cast<float>(random.uniform()), static_cast<float>(random.uniform())});
        CHECK(std::abs(glm::length(direction) - 1.0f) < 1e-5f);
        mean += glm::dvec3(direction) / double{count};
        squares += glm::dvec3(direction) * glm::dvec3(direction) / double{count};
    }
    // Integrals of z^2 / pi and z^3 / pi over the hemisphere; what is left of a unit vector is shared by x,
    // y.
    CHECK(glm::length(mean - glm::dvec3(0.0, 0.0, 2.0 / 3.0)) < 0.01);
    CHECK(glm::length(squares - glm::dvec3(0.25, 0.25, 0.5)) < 0.01);
}

TEST_CASE("no sample of a rough surface carries more than it got", "[unit]") {
    RandomStream random(9, "rough samples");
    for (int i = 0; i < 20000; ++i) {
        const auto alpha = static_cast<float>(random.uniform(0.001, 1.0));
        const glm::vec3 eye = direction_at(random.uniform(1e-3, 1.0), random.uniform(0.0, 6.28));
        const glm::vec3 m = ggx_visible_normal(
            eye, alpha, {static_cast<float>(random.uniform()), static_cast<float>(random.uniform())});
        const glm::vec3 out = 2.0f * glm::dot(eye, m) * m - eye;
        CHECK(std::abs(glm::length(m) - 1.0f) < 1e-5f);
        CHECK(glm::dot(eye, m) >= -1e-5f);
        const float weight = ggx_visible_share(out, alpha);
        CHECK((weight >= 0.0f && weight <= 1.0f));
    }
}
