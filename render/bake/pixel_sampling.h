/// Where in and around its pixel a sample goes.
#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "render/bake/bake_settings.h"

namespace overt {

/// Spreads a pixel's samples with the density of its filter, so that all count alike and each in its own
/// pixel alone. The filters are products of one in x and one in y; a width is that of the whole filter: box:
/// even; gaussian: sigma = width / 6, cut off at the ends; blackman_harris: the four-term window of Harris
/// (1978), whose side lobes are below -92 dB.
class PixelSampling {
  public:
    PixelSampling(PixelFilter filter, double width_px);

    /// Offset from the pixel's middle in pixels, of a place in the unit square.
    glm::vec2 offset(glm::vec2 place) const { return {offset(place.x), offset(place.y)}; }

  private:
    float offset(float place) const;

    std::vector<float> quantiles_; ///< offset for which each 1/1024 of the filter's weight lies further left
};

} // namespace overt
