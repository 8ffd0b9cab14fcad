/// A surface that mirrors in a lobe of micro-mirrors, and gives back evenly what they leave it: a plastic, a
/// rough metal with all light between its mirrors or without, each under a clear coat or without. Reciprocal;
/// where its colours are white it gives back all light, but under a coat, or of a metal without the light
/// between its mirrors.
///
/// f(v, l) = F(v.h) D G1(v) G1(l) / (4 cos_v cos_l) + C (1 - E(v)) (1 - E(l)) / (pi (1 - mean E)),
///
/// where E is the share of light that the first term gives back, of mirrors as they are or without loss
/// (Kelemen and Szirmay-Kalos 2001, "A microfacet based coupled specular-matte BRDF model"; Kulla and Conty
/// 2017, "Revisiting physically based shading at Imageworks").
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "render/bake/conductor.h"
#include "render/bake/material_model.h"

namespace overt {

/// Changes whenever the same inputs would give other light: part of the key under which frames are kept.
constexpr int layered_surface_version = 1;

/// Which share of light from a direction micro-mirrors give back at once, over all directions, by the cosine
/// of the direction.
class LobeAlbedo {
  public:
    LobeAlbedo() = default;
    /// `alpha`: GGX, 1e-4 … 1. `reflectance`: of one mirror, by the cosine of the angle to it.
    LobeAlbedo(double alpha, const std::function<double(double cosine)>& reflectance);

    float at(float cosine) const;
    /// Of light that comes evenly from everywhere.
    float mean() const { return mean_; }

  private:
    static constexpr int rows = 129; // even in the root of the cosine, for what is steep near grazing
    std::vector<float> share_;
    float mean_ = 0.0f;
};

/// Made once for a stimulus and asked from any number of threads.
class LayeredSurface {
  public:
    /// Mirrors of one roughness.
    struct Mirrors {
        float alpha = 0.0f;         ///< GGX, 1e-4 … 1
        ConductorTable reflectance; ///< of one mirror, by the cosine of the angle to it
        LobeAlbedo albedo;          ///< of all of them together, the mean over the bins
    };
    /// What is given back evenly, C with its E.
    struct Even {
        Bins colour;
        LobeAlbedo taken;
    };

    Mirrors mirrors;
    std::vector<Even> evens;
    /// Above all of it, if there is one: it mirrors in a lobe of its own, and what is below counts times
    /// (1 - E(v)) (1 - E(l)), E being its albedo.
    std::optional<Mirrors> coat;

    /// Gives a direction with density(), and takes from `carried` what take() does; (0, 0, 0) if it leads
    /// below the surface.
    glm::vec3 scatter(const SurfaceEvent& event, SampleSequence& sequence, Bins& carried) const;
    /// Per solid angle, of a direction of unit length; 0 below the surface.
    float density(const SurfaceEvent& event, glm::vec3 onward) const;
    /// Times f cos / density.
    void take(const SurfaceEvent& event, glm::vec3 onward, Bins& carried) const;

    /// f itself, for comparisons.
    Bins value(const SurfaceEvent& event, glm::vec3 onward) const;

  private:
    struct Chances;
    Chances chances(float cosine) const;
};

/// Light from within, of all that comes to the boundary from everywhere in a body of index `ior`, that the
/// boundary throws back: 1 - (1 - F) / ior^2, F being the mean from outside (Fresnel, smooth).
double inner_reflectance(double ior);

/// Share of light from everywhere outside that a smooth surface of index `ior` mirrors.
double outer_reflectance(double ior);

// What the kinds are made of. `reflectance`: the bins of MaterialSettings::reflectance.
LayeredSurface plastic_surface(const MaterialSettings& material, const Bins& reflectance);
LayeredSurface metallic_roughness_surface(const MaterialSettings& material, const Bins& reflectance);
/// The clear coat of any of them; nothing without one.
std::optional<LayeredSurface::Mirrors> clear_coat_of(const MaterialSettings& material);

/// The nearest alpha that a lobe can have.
float usable_alpha(double alpha);

/// With the light between its mirrors where `material` has multiple_scattering.
LayeredSurface rough_metal_surface(const MaterialSettings& material, const ConductorTable& metal);

} // namespace overt
