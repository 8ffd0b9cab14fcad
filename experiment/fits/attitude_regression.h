/// Attitudes that were set over those of the surface: what an observer makes of slants, place by place.
#pragma once

#include <optional>
#include <span>

#include <glm/glm.hpp>

#include "experiment/attitude.h"

namespace overt {

/// Of a surface that leans by slant and tilt: by how much its depth rises to the right and upwards, the
/// tangent of the slant towards the tilt.
glm::dvec2 depth_rise(const Attitude& attitude);

struct AttitudePair {
    Attitude set, truth;
};

/// Where the surface is seen more steeply than this, its rise weighs so much that it decides alone, and
/// settings there are the least sure: such places are left out of the regression.
inline constexpr double steepest_regressed_deg = 75.0;
/// Settings steeper than this count as this: one that was left on edge by mistake must not decide either.
inline constexpr double steepest_set_deg = 80.0;

/// rise set = gain x true rise + shear, both components with one gain.
struct AttitudeRegression {
    double gain = 0.0;
    glm::dvec2 shear{0.0};
    double r = 0.0; ///< correlation of both components about their means
    int count = 0;  ///< settings
};

/// Least squares over the settings; It needs no
/// neighbours, so that it holds where places lie farther apart than the folds of the surface. Nothing for
/// fewer than three settings, or if all places lean alike.
std::optional<AttitudeRegression> regress_attitudes(std::span<const AttitudePair> pairs);

} // namespace overt
