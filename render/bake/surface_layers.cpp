/// What the layered kinds of material are made of.
#include <algorithm>
#include <cmath>

#include "render/bake/layered_surface.h"

namespace overt {

namespace {

/// Smoother than this a lobe is taken for this smooth: narrower than a hundredth of a degree it is a mirror.
constexpr double least_alpha = 1e-4;

double usable(double alpha) { return std::clamp(alpha, least_alpha, 1.0); }

double fresnel_of(double ior, double cosine) {
    return static_cast<double>(dielectric_fresnel(static_cast<float>(ior), static_cast<float>(cosine)));
}

double mean_of(const Bins& bins) {
    double sum = 0.0;
    for (std::size_t bin = 0; bin < spectral_bins; ++bin)
        sum += static_cast<double>(bins.value[bin]);
    return sum / static_cast<double>(spectral_bins);
}

Bins reflected(const ConductorTable& table, double cosine) {
    Bins bins = Bins::filled(1.0f);
    table.multiply_into(bins, static_cast<float>(cosine));
    return bins;
}

LayeredSurface::Mirrors mirrors_of(double alpha, ConductorTable reflectance) {
    LobeAlbedo albedo(alpha, [&](double cosine) { return mean_of(reflected(reflectance, cosine)); });
    return {static_cast<float>(alpha), std::move(reflectance), std::move(albedo)};
}

/// What micro-mirrors of metal send on to one another until it leaves: F_mean^2 E / (1 - F_mean (1 - E)),
/// F_mean being the mirrors' own mean and E what mirrors without loss give back at once (Kulla and Conty
/// 2017).
LayeredSurface::Even between_mirrors(double alpha, const ConductorTable& metal, float share) {
    LobeAlbedo lossless(alpha, [](double) { return 1.0; });
    Bins mean{};
    constexpr int steps = 256;
    for (int i = 0; i < steps; ++i) {
        const double cosine = (i + 0.5) / steps;
        Bins at = reflected(metal, cosine);
        scale(at, static_cast<float>(2.0 * cosine / steps));
        add(mean, at);
    }
    const float given = lossless.mean();
    Bins colour{};
    for (std::size_t bin = 0; bin < spectral_bins; ++bin) {
        const float f = mean.value[bin];
        colour.value[bin] = share * f * f * given / (1.0f - f * (1.0f - given));
    }
    return {colour, std::move(lossless)};
}

} // namespace

double outer_reflectance(double ior) {
    // Steep near grazing: even steps of the cosine's root.
    constexpr int steps = 20000;
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) {
        const double root = (i + 0.5) / steps;
        sum += fresnel_of(ior, root * root) * 4.0 * root * root * root / steps;
    }
    return sum;
}

double inner_reflectance(double ior) { return 1.0 - (1.0 - outer_reflectance(ior)) / (ior * ior); }

LayeredSurface plastic_surface(const MaterialSettings& material, const Bins& reflectance) {
    const double ior = material.ior;
    LayeredSurface surface;
    surface.mirrors = mirrors_of(usable(material.alpha()), ConductorTable([ior](double cosine) {
                                     return Bins::filled(static_cast<float>(fresnel_of(ior, cosine)));
                                 }));
    Bins colour = reflectance;
    if (material.body == PlasticBody::pigment) {
        const auto inner = static_cast<float>(inner_reflectance(ior));
        for (float& value : colour.value)
            value *= (1.0f - inner) / (1.0f - value * inner);
    }
    surface.evens.push_back({colour, surface.mirrors.albedo});
    surface.coat = clear_coat_of(material);
    return surface;
}

LayeredSurface rough_metal_surface(const MaterialSettings& material, const ConductorTable& metal) {
    LayeredSurface surface;
    const double alpha = usable(material.alpha());
    surface.mirrors = mirrors_of(alpha, metal);
    if (material.multiple_scattering)
        surface.evens.push_back(between_mirrors(alpha, metal, 1.0f));
    surface.coat = clear_coat_of(material);
    return surface;
}

LayeredSurface metallic_roughness_surface(const MaterialSettings& material, const Bins& reflectance) {
    LayeredSurface surface;
    const double alpha = usable(material.alpha()), ior = material.ior;
    const auto metallic = static_cast<float>(material.given_metallic());
    // Schlick's curve from the colour at normal incidence to white (glTF 2.0, appendix B).
    const ConductorTable metal([&](double cosine) {
        const auto rise = static_cast<float>(std::pow(1.0 - cosine, 5));
        Bins bins{};
        for (std::size_t bin = 0; bin < spectral_bins; ++bin)
            bins.value[bin] = reflectance.value[bin] + (1.0f - reflectance.value[bin]) * rise;
        return bins;
    });
    const ConductorTable both([&](double cosine) {
        Bins bins = reflected(metal, cosine);
        scale(bins, metallic);
        add(bins, Bins::filled((1.0f - metallic) * static_cast<float>(fresnel_of(ior, cosine))));
        return bins;
    });
    surface.mirrors = mirrors_of(alpha, both);
    if (metallic < 1.0f) {
        Bins colour = reflectance;
        scale(colour, 1.0f - metallic);
        surface.evens.push_back(
            {colour, LobeAlbedo(alpha, [ior](double cosine) { return fresnel_of(ior, cosine); })});
    }
    if (metallic > 0.0f)
        surface.evens.push_back(between_mirrors(alpha, metal, metallic));
    surface.coat = clear_coat_of(material);
    return surface;
}

std::optional<LayeredSurface::Mirrors> clear_coat_of(const MaterialSettings& material) {
    if (!(material.clear_coat > 0.0))
        return std::nullopt;
    constexpr double coat_ior = 1.5; // KHR_materials_clearcoat
    const auto share = static_cast<float>(material.clear_coat);
    return mirrors_of(usable(material.clear_coat_roughness * material.clear_coat_roughness),
                      ConductorTable([share](double cosine) {
                          return Bins::filled(share * static_cast<float>(fresnel_of(coat_ior, cosine)));
                      }));
}

float usable_alpha(double alpha) { return static_cast<float>(usable(alpha)); }

} // namespace overt
