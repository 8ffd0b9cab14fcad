#include "render/bake/medium.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "render/bake/light_colour.h"
#include "render/bake/microfacets.h"

namespace overt {

namespace {

Bins coefficients(const std::array<double, 3>& rgb, double density) {
    Bins bins = Bins::of(absorbance_of(rgb));
    scale(bins, static_cast<float>(density));
    return bins;
}

/// Of the 31, in four sums that are added up at the end, so that all processors give the same bits.
float mean_of(const Bins& bins) {
    float sums[4]{};
    for (std::size_t i = 0; i < Bins::padded; i += 4)
        for (std::size_t lane = 0; lane < 4; ++lane)
            sums[lane] += bins.value[i + lane];
    return ((sums[0] + sums[1]) + (sums[2] + sums[3])) / static_cast<float>(spectral_bins);
}

} // namespace

Medium::Medium(const MaterialSettings& material)
    : scattering_(coefficients(material.scattering_per_mm, material.density)),
      absorption_(coefficients(material.absorption_per_mm, material.density)),
      most_scattering_(scattering_.largest()),
      anisotropy_(static_cast<float>(material.scattering_anisotropy)) {
    const auto& [red, green, blue] = material.scattering_per_mm;
    is_grey_ = red == green && green == blue;
    absorbs_ = absorption_.largest() > 0.0f;
    constexpr float of_none = -1000.0f; // so small a chance is none
    for (std::size_t bin = 0; bin < Bins::padded; ++bin)
        log_scattering_.value[bin] =
            scattering_.value[bin] > 0.0f ? std::log2(scattering_.value[bin]) : of_none;
}

void Medium::enter(MediumPath& path, float number, std::uint64_t seed) {
    path.band = std::min(static_cast<int>(number * static_cast<float>(spectral_bins)), spectral_bins - 1);
    path.chance = Bins::filled(1.0f);
    path.chance.value.back() = 0.0f; // it is no band
    path.numbers = WalkNumbers(seed);
}

float Medium::free_path(int band, float number) const {
    const float scattering = scattering_.value[static_cast<std::size_t>(band)];
    return scattering > 0.0f ? -std::log(1.0f - number) / scattering : std::numeric_limits<float>::infinity();
}

void Medium::settle(MediumPath& path, Bins& carried) const {
    if (absorbs_)
        absorb(carried, absorption_, path.absorbed_over);
    if (!is_grey_) {
        const auto band = static_cast<std::size_t>(path.band);
        const FlightChances flights{log_scattering_, scattering_, log_scattering_.value[band],
                                    scattering_.value[band]};
        const auto count = static_cast<float>(path.unsettled);
        multiply_by_flights(path.chance, flights, count, path.flown);
        multiply_by_flights(carried, flights, count, path.flown);
        const float by_mean = 1.0f / mean_of(path.chance);
        scale_or_drop(path.chance, by_mean);
        scale_or_drop(carried, by_mean);
    }
    path.unsettled = 0;
    path.flown = path.absorbed_over = 0.0f;
}

glm::vec3 Medium::onward(glm::vec3 direction, glm::vec2 numbers) const {
    const float g = anisotropy_;
    float cosine = 1.0f - 2.0f * numbers.x;
    if (std::abs(g) > 1e-3f) {
        const float root = (1.0f - g * g) / (1.0f + g * cosine);
        cosine = std::clamp((1.0f + g * g - root * root) / (2.0f * g), -1.0f, 1.0f);
    }
    const float sine = std::sqrt(std::max(0.0f, 1.0f - cosine * cosine));
    const float around = 2.0f * std::numbers::pi_v<float> * numbers.y;
    return glm::normalize(
        NormalFrame(direction).to_world({sine * std::cos(around), sine * std::sin(around), cosine}));
}

double Medium::phase(double anisotropy, double cosine) {
    const double g = anisotropy;
    return (1.0 - g * g) / (4.0 * std::numbers::pi * std::pow(1.0 + g * g - 2.0 * g * cosine, 1.5));
}

double half_space_albedo(double albedo, double anisotropy) {
    if (!(albedo > 0.0))
        return 0.0;
    const double s = std::sqrt((1.0 - albedo) / (1.0 - albedo * anisotropy));
    return (1.0 - s) * (1.0 - 0.139 * s) / (1.0 + 1.17 * s);
}

} // namespace overt
