/// The gallery's light has the statistics of natural illumination.
#include "render/image/gallery_probe.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include <catch2/catch.hpp>

using namespace overt;

namespace {

constexpr double pi = std::numbers::pi;

double luminance(const glm::vec4& light) {
    return 0.2126 * static_cast<double>(light.r) + 0.7152 * static_cast<double>(light.g) +
           0.0722 * static_cast<double>(light.b);
}

/// Luminance with the share of the sphere that it comes from.
struct Patch {
    double luminance, share;
};

std::vector<Patch> patches_of(const LinearImage& radiance) {
    std::vector<Patch> patches;
    const glm::ivec2 size = radiance.size_px;
    for (int y = 0; y < size.y; ++y) {
        const double share = 0.5 * (std::cos(pi * y / size.y) - std::cos(pi * (y + 1) / size.y)) / size.x;
        for (int x = 0; x < size.x; ++x)
            patches.push_back({luminance(radiance.at(x, y)), share});
    }
    return patches;
}

/// Power of a spherical function, in the mean of the coefficients of each degree: Legendre functions by the
/// recurrence over the degree.
std::vector<double> power_by_degree(const std::vector<double>& values, glm::ivec2 size, int most_degree) {
    std::vector<double> power(static_cast<std::size_t>(most_degree) + 1, 0.0);
    for (int m = 0; m <= most_degree; ++m) {
        std::vector<std::complex<double>> sums(power.size(), 0.0);
        for (int y = 0; y < size.y; ++y) {
            const double angle = pi * (y + 0.5) / size.y, z = std::cos(angle), sine = std::sin(angle);
            std::complex<double> wave = 0.0;
            for (int x = 0; x < size.x; ++x) {
                wave += values[static_cast<std::size_t>(y * size.x + x)] *
                        std::polar(1.0, -2.0 * pi * m * x / size.x);
            }
            wave *= 2.0 * pi / size.x * pi / size.y * sine;
            double before = 0.0, now = std::sqrt(1.0 / (4.0 * pi));
            for (int k = 1; k <= m; ++k)
                now *= -std::sqrt((2.0 * k + 1.0) / (2.0 * k)) * sine;
            for (int l = m; l <= most_degree; ++l) {
                sums[static_cast<std::size_t>(l)] += now * wave;
                const double n = l + 1.0, a = std::sqrt((4.0 * n * n - 1.0) / (n * n - m * m));
                const double b = l == m ? 0.0
                                        : std::sqrt((static_cast<double>(l) * l - m * m) /
                                                    (4.0 * static_cast<double>(l) * l - 1.0));
                const double next = a * (z * now - b * before);
                before = now;
                now = next;
            }
        }
        for (int l = m; l <= most_degree; ++l)
            power[static_cast<std::size_t>(l)] +=
                (m == 0 ? 1.0 : 2.0) * std::norm(sums[static_cast<std::size_t>(l)]) / (2.0 * l + 1.0);
    }
    return power;
}

/// Of a straight line through the logarithms.
double slope(const std::vector<double>& power, int from, int to) {
    double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, n = 0.0;
    for (int l = from; l <= to; ++l) {
        const double a = std::log(l), b = std::log(power[static_cast<std::size_t>(l)]);
        x += a;
        y += b;
        xx += a * a;
        xy += a * b;
        n += 1.0;
    }
    return (n * xy - x * y) / (n * xx - x * x);
}

} // namespace

TEST_CASE("the gallery has a high dynamic range, and little of it gives much of its light", "[unit]") {
    std::vector<Patch> patches = patches_of(gallery_probe().radiance);
    std::sort(patches.begin(), patches.end(),
              [](const Patch& a, const Patch& b) { return a.luminance > b.luminance; });
    CHECK(patches.front().luminance / patches.back().luminance > 1e4);
    CHECK(patches.back().luminance > 0.0);
    double light = 0.0, all = 0.0, share = 0.0, of_brightest = 0.0;
    for (const Patch& patch : patches)
        all += patch.luminance * patch.share;
    for (const Patch& patch : patches) {
        light += patch.luminance * patch.share;
        share += patch.share;
        if (share <= 0.01)
            of_brightest = light / all;
    }
    CHECK(share == Approx(1.0));
    CHECK(of_brightest > 0.3);
    CHECK(of_brightest < 0.7);
}

TEST_CASE("the logarithm of the gallery's luminance has a peak and a long tail to the bright side",
          "[unit]") {
    // Skewed and more peaked than a normal distribution, as Dror, Willsky and Adelson (2004) found it in
    // photographed surroundings.
    double mean = 0.0, squares = 0.0, cubes = 0.0, fourths = 0.0;
    const std::vector<Patch> patches = patches_of(gallery_probe().radiance);
    for (const Patch& patch : patches)
        mean += patch.share * std::log(patch.luminance);
    for (const Patch& patch : patches) {
        const double off = std::log(patch.luminance) - mean;
        squares += patch.share * off * off;
        cubes += patch.share * off * off * off;
        fourths += patch.share * off * off * off * off;
    }
    const double skewness = cubes / std::pow(squares, 1.5), kurtosis = fourths / (squares * squares);
    CAPTURE(std::sqrt(squares), skewness, kurtosis);
    CHECK(std::sqrt(squares) > 0.8);
    CHECK(skewness > 0.3);
    CHECK(kurtosis > 3.5);
}

TEST_CASE("the power of a spherical harmonic comes back in its own degree", "[unit]") {
    const glm::ivec2 size(128, 64);
    std::vector<double> values;
    for (int y = 0; y < size.y; ++y) {
        const double z = std::cos(pi * (y + 0.5) / size.y);
        for (int x = 0; x < size.x; ++x) // sqrt(15 / 4 pi) x z, which is real and of degree 2 and order 1
            values.push_back(std::sqrt(15.0 / (4.0 * pi)) * z * std::sqrt(1.0 - z * z) *
                             std::cos(2.0 * pi * x / size.x));
    }
    const std::vector<double> power = power_by_degree(values, size, 5);
    CHECK(power[2] == Approx(1.0 / 5.0).epsilon(0.01));
    for (const std::size_t other : {0u, 1u, 3u, 4u, 5u})
        CHECK(power[other] < 1e-3);
}

TEST_CASE("the power of the gallery's harmonics falls about with the square of their degree", "[unit]") {
    const LinearImage small = reduced(gallery_probe(), {256, 128}).radiance;
    std::vector<double> logarithms;
    for (const glm::vec4& pixel : small.pixels)
        logarithms.push_back(std::log(luminance(pixel)));
    const double fitted = slope(power_by_degree(logarithms, small.size_px, 48), 2, 48);
    CAPTURE(fitted);
    CHECK(fitted < -1.7);
    CHECK(fitted > -2.6);
}

TEST_CASE("the gallery is darker below than above, its lamps and sun are warm, its sky is blue", "[unit]") {
    const LinearImage& radiance = gallery_probe().radiance;
    double above = 0.0, below = 0.0, mean = 0.0;
    const std::vector<Patch> patches = patches_of(radiance);
    for (std::size_t i = 0; i < patches.size(); ++i) {
        (i < patches.size() / 2 ? above : below) += patches[i].share * patches[i].luminance;
        mean += patches[i].share * patches[i].luminance;
    }
    CHECK(mean == Approx(gallery_mean_luminance).epsilon(1e-3));
    CHECK(above > 2.0 * below);
    glm::dvec3 brightest(0.0);
    double warm = 0.0, cool = 0.0;
    for (const glm::vec4& pixel : radiance.pixels) {
        REQUIRE(std::min({pixel.r, pixel.g, pixel.b}) > 0.0f);
        if (luminance(pixel) > luminance(glm::vec4(glm::vec3(brightest), 1.0f)))
            brightest = glm::dvec3(pixel);
        // Bright, but for the sources themselves: sky, or patches of sun.
        warm += pixel.r > 1.3f * pixel.b && luminance(pixel) > gallery_mean_luminance;
        cool += pixel.b > 1.3f * pixel.r && luminance(pixel) > gallery_mean_luminance;
    }
    CHECK(brightest.r > 1.5 * brightest.b);
    CHECK(warm > 2000.0);
    CHECK(cool > 2000.0);
}
