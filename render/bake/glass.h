/// Glass as a path meets it: polished or rough, with one index or one for each band of the spectrum.
#pragma once

#include <array>
#include <optional>

#include "experiment/protocol/protocol.h"
#include "render/bake/sample_sequence.h"
#include "render/bake/spectral_bins.h"

namespace overt {

/// Changes whenever the same inputs would give other light: part of the key under which frames are kept.
constexpr int glass_version = 1;

/// What a meeting with the surface makes of a path: it may be mirrored or go through.
struct GlassMeeting {
    glm::vec3 back{0.0f}, through{0.0f}; ///< directions, of unit length
    bool goes_through = false;           ///< else all of it is mirrored
    float chance_back = 1.0f;            ///< a good chance to choose the way back with
    Bins mirrored, passed; ///< shares of what is carried; `passed` has all of `band`, if one is chosen
    /// Of a rough surface, what is not hidden by other parts of it; what meets it twice is lost.
    float mirrored_share = 1.0f, passed_share = 1.0f;
    int band = -1; ///< the only one that a path has that goes through; -1: all
};

/// Made once for a stimulus and asked from any number of threads.
class Glass {
  public:
    /// Of kind `glass`. With an Abbe number the index follows Cauchy's A + B / wavelength^2 through `ior` at
    /// 587.6 nm (for N-BK7 that is off by 1.3e-4 at most from 400 to 700 nm).
    explicit Glass(const MaterialSettings& material);

    bool disperses() const { return disperses_; }
    /// Of a band; without dispersion of all.
    float index(int band) const { return disperses_ ? indices_[static_cast<std::size_t>(band)] : ior_; }

    /// A path that comes from `to_eye` meets the surface of shading normal `normal` and `surface_normal`,
    /// both on its side. `enters`: from outside. `band`: of the path. Radiance changes by the square of the
    /// index where it enters and back where it leaves, so that it counts as unchanged. Rough: micro-mirrors
    /// by GGX (Walter et al. 2007), followed once.
    GlassMeeting meet(glm::vec3 to_eye, glm::vec3 normal, glm::vec3 surface_normal, bool enters, int band,
                      SampleSequence& sequence) const;

  private:
    float ior_;
    bool disperses_;
    float alpha_ = 0.0f; ///< 0: polished
    std::array<float, spectral_bins> indices_{};
};

} // namespace overt
