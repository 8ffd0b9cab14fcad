/// The light around the object as the path tracer looks it up: 31 bins from every direction.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "experiment/protocol/protocol.h"
#include "render/bake/light_aim.h"
#include "render/bake/light_sources.h"
#include "render/bake/spectral_bins.h"
#include "render/image/light_probe.h"

namespace overt {

/// Made once for a light; looked up from any number of threads.
class SpectralLight {
  public:
    /// The protocol's probe (see load_light_probe, which throws InputError). The exposure does not change the
    /// light; it is kept for judging errors by.
    explicit SpectralLight(const LightSettings& light);

    /// A probe that is there already. It must be as high as it is wide, or half.
    SpectralLight(const LightProbe& probe, double exposure, double rotation_deg = 0.0);

    /// Turns the probe by this from where its settings have it, counter-clockwise seen from above. Not while
    /// others look it up.
    void turn_to(Degrees turn) { turn_deg_ = turn.value; }

    /// Linear Rec.709 light that comes from `direction` (unit length), as an object sees it that is turned by
    /// `turn` of share_of_turn(). Bilinear between texels, round the horizon and across the poles.
    glm::vec3 towards(glm::vec3 direction, float turn) const;

    /// Where paths are aimed at, or null where the light is broad: LightAim::pays.
    const LightAim* aim() const { return aim_ ? &*aim_ : nullptr; }

    /// The sun and the lamps that shine besides, as an object has them that stands so, about the
    /// centre of its box: turned as the light is, and seen from the object's own coordinates.
    std::vector<LightSource> sources_at(const ObjectPose& object) const;

    /// For comparisons: paths find sources by chance alone.
    void aim_nowhere() { aim_.reset(); }

    /// What an object's turn adds to a direction's place in the probe: the object stays, its surroundings
    /// turn back.
    float share_of_turn(Degrees angle) const;

    /// Spectra of red, green and blue.
    const RgbBasis& basis() const { return basis_; }
    double exposure() const { return exposure_; }

    /// What an experimenter should know of the probe, a sentence each; empty if there is nothing to say.
    const std::vector<std::string>& notes() const { return notes_; }

  private:
    glm::ivec2 size_{0}; ///< of the probe
    int stride_ = 0;     ///< texels of a row, with a column more at each side
    std::vector<glm::vec4> texels_;
    std::optional<LightAim> aim_;
    std::vector<LightSource> sources_; ///< see light_sources()
    RgbBasis basis_;
    double exposure_ = 1.0;
    double rotation_deg_ = 0.0, turn_deg_ = 0.0;
    std::vector<std::string> notes_;
};

} // namespace overt
