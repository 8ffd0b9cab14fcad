#include "render/bake/glass.h"

#include <algorithm>
#include <cmath>

#include "render/bake/conductor.h"
#include "render/bake/microfacets.h"

namespace overt {

namespace {

/// n_F - n_C by the Abbe number, and from it Cauchy's B, with the lines' wavelengths in nm.
double cauchy_b(double ior, double abbe) {
    constexpr double f = 486.13, c = 656.27;
    return (ior - 1.0) / abbe / (1.0 / (f * f) - 1.0 / (c * c));
}

} // namespace

Glass::Glass(const MaterialSettings& material)
    : ior_(static_cast<float>(material.ior)), disperses_(material.abbe.has_value()),
      alpha_(material.roughness ? static_cast<float>(material.alpha()) : 0.0f) {
    if (!disperses_)
        return;
    constexpr double d = 587.56;
    const double b = cauchy_b(material.ior, *material.abbe), a = material.ior - b / (d * d);
    for (std::size_t bin = 0; bin < spectral_bins; ++bin) {
        const double wavelength = first_bin_centre_nm + bin_width_nm * static_cast<double>(bin);
        indices_[bin] = static_cast<float>(a + b / (wavelength * wavelength));
    }
}

GlassMeeting Glass::meet(glm::vec3 to_eye, glm::vec3 normal, glm::vec3 surface_normal, bool enters, int band,
                         SampleSequence& sequence) const {
    GlassMeeting met;
    met.band = band;
    // Colours part where a path goes in that has them all: each is followed as often.
    const bool parts = disperses_ && band < 0;
    if (parts)
        met.band = std::min(static_cast<int>(sequence.next() * static_cast<float>(spectral_bins)),
                            spectral_bins - 1);
    const auto relative = [&](int of) { return enters ? index(of) : 1.0f / index(of); };
    const NormalFrame frame(normal);
    const auto refracted = [&](glm::vec3 micro) {
        return glm::refract(-to_eye, micro, 1.0f / relative(met.band));
    };
    glm::vec3 micro = normal;
    if (alpha_ > 0.0f)
        micro = frame.to_world(ggx_visible_normal(frame.to_local(to_eye), alpha_, sequence.next_two()));
    met.through = refracted(micro);
    constexpr float least_depth = 1e-5f;
    const auto is_wrong = [&] {
        return met.through != glm::vec3(0.0f) && glm::dot(met.through, surface_normal) > -least_depth;
    };
    if (alpha_ == 0.0f && is_wrong()) {
        // The shading normal would send it back: then the triangle's own normal has the say.
        micro = surface_normal;
        met.through = refracted(micro);
    }
    const float cosine = std::clamp(glm::dot(micro, to_eye), 0.0f, 1.0f);
    met.back = glm::normalize(2.0f * cosine * micro - to_eye);
    met.goes_through = met.through != glm::vec3(0.0f);
    if (met.goes_through)
        met.through = glm::normalize(met.through);
    const float reflected = met.goes_through ? dielectric_fresnel(relative(met.band), cosine) : 1.0f;
    met.mirrored = Bins::filled(reflected);
    met.passed = Bins::filled(1.0f - reflected);
    met.chance_back = reflected;
    if (parts) {
        met.passed = Bins{};
        met.passed.value[static_cast<std::size_t>(met.band)] =
            static_cast<float>(spectral_bins) * (1.0f - reflected);
        float sum = 0.0f;
        for (std::size_t bin = 0; bin < spectral_bins; ++bin) {
            met.mirrored.value[bin] = dielectric_fresnel(relative(static_cast<int>(bin)), cosine);
            sum += met.mirrored.value[bin];
        }
        met.chance_back = sum / static_cast<float>(spectral_bins);
    }
    if (alpha_ > 0.0f) {
        const glm::vec3 back = frame.to_local(met.back), through = frame.to_local(met.through);
        met.mirrored_share = back.z > 0.0f ? ggx_visible_share(back, alpha_) : 0.0f;
        met.passed_share =
            met.goes_through && through.z < 0.0f && !is_wrong() ? ggx_visible_share(-through, alpha_) : 0.0f;
    }
    return met;
}

} // namespace overt
