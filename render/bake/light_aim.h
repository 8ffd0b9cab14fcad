/// Directions in which there is much light, so that paths can be aimed there.
#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "render/image/light_probe.h"

namespace overt {

/// A density over all directions that follows the luminance of a probe: even within each of its texels (of
/// blocks of texels, where a probe has more than 1024 in a row), rows being chosen first and then the column
/// (Pharr, Jakob and Humphreys 2016, "Physically Based Rendering", 13.6.7). Made once for a light, used from
/// any number of threads.
class LightAim {
  public:
    explicit LightAim(const LightProbe& probe);

    /// Whether aiming is worth a ray: whether the light is so uneven that the mean of its square over all
    /// directions is more than 4 times the square of its mean.
    bool pays() const { return unevenness_ > 4.0; }

    /// Unit direction for a place in the unit square, seen by an object that is turned by `turn`
    /// (SpectralLight::share_of_turn). Neighbouring places have neighbouring directions, mostly.
    glm::vec3 direction(glm::vec2 place, float turn) const;

    /// Per steradian, with which direction() gives it.
    float density(glm::vec3 direction, float turn) const;

    /// Mean of the squared luminance by the square of its mean: 1 if the light is the same everywhere.
    double unevenness() const { return unevenness_; }

  private:
    std::size_t cell(int column, int row) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
               static_cast<std::size_t>(column);
    }

    int columns_ = 0, rows_ = 0;
    float column_width_ = 1.0f, row_width_ = 1.0f; ///< of a cell, as a share of all
    std::vector<float> row_end_;                   ///< share of the light in the rows up to and with each
    std::vector<float> column_end_; ///< in each row, share of its light in the columns up to and with each
    std::vector<float> density_;    ///< of each cell
    std::vector<float> height_;     ///< z at each row's upper edge, and at the nadir
    double unevenness_ = 1.0;
};

} // namespace overt
