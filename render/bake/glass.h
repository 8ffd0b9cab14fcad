/// Glass as a path meets it: polished or rough, with one index or one for each band of the spectrum.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "experiment/protocol/protocol.h"
#include "render/bake/sample_sequence.h"
#include "render/bake/spectral_bins.h"

namespace overt {

/// Changes whenever the same inputs would give other light: part of the key under which frames are kept.
constexpr int glass_version = 2;

/// How a path goes on from where it first meets a surface of glass.
enum class GlassTurn : std::uint8_t { by_chance, mirrored, let_through };

/// How a path leaves a surface of glass again.
struct GlassWay {
    glm::vec3 direction{0.0f}; ///< of unit length
    bool goes_through = false; ///< to the other side of the surface; it may have been there before
    Bins carried;              ///< what is left of 1; all 0: there is no such way
    int band = -1;             ///< the only one that is carried; -1: all
    int facets = 1;            ///< of rough glass: how many it has met
};

/// Made once for a stimulus and asked from any number of threads.
class Glass {
  public:
    /// Of kind `glass`, or the border of a `translucent` body. With an Abbe number the index follows Cauchy's
    /// A + B / wavelength^2 through `ior` at 587.6 nm (for N-BK7 that is off by 1.3e-4 at most from 400 to
    /// 700 nm).
    explicit Glass(const MaterialSettings& material);

    bool disperses() const { return disperses_; }
    /// Of a band; without dispersion of all.
    float index(int band) const { return disperses_ ? indices_[static_cast<std::size_t>(band)] : ior_; }

    /// A path that comes from `to_eye` meets the surface of shading normal `normal` and `surface_normal`,
    /// both on its side. `enters`: from outside. `band`: of the path. `turn`: at the first facet; of
    /// `mirrored` and `let_through` both together carry what `by_chance` does in the mean. Radiance changes
    /// by the square of the index where it enters and back where it leaves, so that it counts as unchanged.
    ///
    /// Rough glass is a crowd of facets (GGX) at heights that are independent of their slopes (Smith). A path
    /// goes from one to the next until it has left them, above or below, so that no light is lost (Heitz,
    /// Hanika, d'Eon & Dachsbacher 2016, "Multiple-scattering microfacet BSDFs with the Smith model"). What
    /// it meets once has the shadowing of that surface: of light mirrored 1 / (1 + A + B), of light let
    /// through Euler's beta function of 1 + A and 1 + B, A and B being Smith's lambdas of both directions.
    GlassWay meet(glm::vec3 to_eye, glm::vec3 normal, glm::vec3 surface_normal, bool enters, int band,
                  GlassTurn turn, SampleSequence& sequence) const;

  private:
    class Colours;
    GlassWay meet_polished(glm::vec3 to_eye, glm::vec3 normal, glm::vec3 surface_normal, GlassTurn turn,
                           Colours& colours, SampleSequence& sequence) const;
    GlassWay meet_rough(glm::vec3 to_eye, glm::vec3 normal, GlassTurn turn, Colours& colours,
                        SampleSequence& sequence) const;

    float ior_;
    bool disperses_;
    float alpha_ = 0.0f; ///< 0: polished
    std::array<float, spectral_bins> indices_{};
};

} // namespace overt
