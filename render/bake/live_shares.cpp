#include "render/bake/live_shares.h"

#include <cmath>

#include "render/bake/layered_surface.h"
#include "render/bake/light_colour.h"
#include "render/bake/medium.h"
#include "render/bake/thin_film.h"

namespace overt {

namespace {

/// The colour under D65 of what sends back such shares of it.
glm::dvec3 rec709_of_shares(const Bins& shares) {
    Spectrum spectrum{};
    for (std::size_t bin = 0; bin < spectral_bins; ++bin)
        spectrum[bin] = static_cast<double>(shares.value[bin]);
    return glm::max(linear_rec709_of(spectrum), 0.0);
}

/// What mirrors of one roughness give back: how much by their albedo, in which colour by one mirror at that
/// angle.
glm::dvec3 mirrored_by(const ConductorTable& mirror, const LobeAlbedo* albedo, float cosine) {
    Bins one = Bins::filled(1.0f);
    mirror.multiply_into(one, cosine);
    const glm::dvec3 colour = rec709_of_shares(one);
    if (!albedo)
        return colour;
    float mean = 0.0f;
    for (std::size_t bin = 0; bin < spectral_bins; ++bin)
        mean += one.value[bin] / static_cast<float>(spectral_bins);
    return mean > 0.0f ? colour * static_cast<double>(albedo->at(cosine) / mean) : glm::dvec3(0.0);
}

float mean_reflectance(const ConductorTable& mirror, double cosine) {
    Bins one = Bins::filled(1.0f);
    mirror.multiply_into(one, static_cast<float>(cosine));
    float mean = 0.0f;
    for (std::size_t bin = 0; bin < spectral_bins; ++bin)
        mean += one.value[bin] / static_cast<float>(spectral_bins);
    return mean;
}

/// A matt body under the same border, of the colour that a half space of the medium has: light that leaves
/// far from where it came in, or on the other side, is not in it.
LayeredSurface as_if_thick(MaterialSettings material) {
    Bins given_back;
    const Medium medium(material);
    for (std::size_t bin = 0; bin < spectral_bins; ++bin) {
        const auto scattered = static_cast<double>(medium.scattering().value[bin]),
                   absorbed = static_cast<double>(medium.absorption().value[bin]);
        if (scattered > 0.0)
            given_back.value[bin] = static_cast<float>(
                half_space_albedo(scattered / (scattered + absorbed), material.scattering_anisotropy));
    }
    material.body = PlasticBody::pigment; // what its border throws back goes in again
    if (!material.roughness)
        material.roughness = 0.001;
    return plastic_surface(material, given_back);
}

/// The mirrors of what is no layered surface: metal as rough as it is in the mean, or glass.
LayeredSurface mirrors_alone(const MaterialSettings& material) {
    LayeredSurface surface;
    surface.mirrors.reflectance = material.kind == MaterialKind::glass ? ConductorTable([&](double cosine) {
        return Bins::filled(dielectric_fresnel(static_cast<float>(material.ior), static_cast<float>(cosine)));
    })
                                                                       : metal_table(material);
    double alpha = 0.0;
    if (material.kind == MaterialKind::rough_conductor) {
        const double along = material.given_roughness(),
                     across = along + (1.0 - along) * material.anisotropy * material.anisotropy;
        alpha = std::sqrt(along * across);
    } else if (material.kind == MaterialKind::glass && material.roughness) {
        alpha = material.alpha();
    }
    if (alpha > 0.0)
        surface.mirrors.albedo = LobeAlbedo(alpha, [&](double cosine) {
            return static_cast<double>(mean_reflectance(surface.mirrors.reflectance, cosine));
        });
    surface.mirrors.alpha = static_cast<float>(alpha);
    return surface;
}

} // namespace

LiveShares live_shares(const MaterialSettings& material) {
    // What is of a file's own colours has one for all here.
    const MaterialModel& model =
        material.is_own()
            ? model_of(material.kind == MaterialKind::own ? MaterialKind::metallic_roughness : material.kind)
            : model_of(material);
    const glm::dvec3 of =
        row_of(material.kind).has_key("reflectance") ? material.given_reflectance() : glm::dvec3(0.0);
    const LayeredSurface surface =
        material.kind == MaterialKind::translucent ? as_if_thick(material)
        : model.layers
            ? model.layers(material, Bins::of(reflectance_of({of.x, of.y, of.z})),
                           row_of(material.kind).has_key("metal") ? metal_table(material) : ConductorTable())
            : mirrors_alone(material);
    const bool is_polished = !model.layers && surface.mirrors.alpha == 0.0f;
    LiveShares shares;
    for (int row = 0; row < LiveShares::rows; ++row) {
        const float root = static_cast<float>(row) / (LiveShares::rows - 1), cosine = root * root;
        glm::dvec3 mirrored = mirrored_by(surface.mirrors.reflectance,
                                          is_polished ? nullptr : &surface.mirrors.albedo, cosine),
                   even(0.0);
        for (const LayeredSurface::Even& part : surface.evens)
            even += static_cast<double>(1.0f - part.taken.at(cosine)) * rec709_of_shares(part.colour);
        double coat = 0.0;
        if (surface.coat) {
            // Light passes the coat twice, from the mirror's direction or from everywhere.
            coat = static_cast<double>(surface.coat->albedo.at(cosine));
            mirrored *= (1.0 - coat) * (1.0 - coat);
            even *= (1.0 - coat) * (1.0 - static_cast<double>(surface.coat->albedo.mean()));
        }
        if (material.kind ==
            MaterialKind::glass) // the rest goes through, on its way across twice half the height
            for (int channel = 0; channel < 3; ++channel)
                even[channel] = (1.0 - mirrored[channel]) *
                                std::exp(-2.0 * material.absorbance[static_cast<std::size_t>(channel)]);
        shares.mirrored.emplace_back(glm::vec3(mirrored), static_cast<float>(coat));
        shares.even.emplace_back(glm::vec3(even), 0.0f);
    }
    return shares;
}

} // namespace overt
