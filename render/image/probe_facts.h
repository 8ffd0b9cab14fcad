/// What the light of a probe is like for seeing gloss by.
#pragma once

#include <optional>
#include <string>

#include "render/image/light_probe.h"

namespace overt {

/// Five numbers by which probes are told apart (Dror, Willsky and Adelson 2004, J. Vision 4(9):11: real
/// surroundings are far from Gaussian, most of their light coming from little of the sphere). Over
/// directions, each by the solid angle of its texel; logarithms of what is above 0.
struct ProbeFacts {
    double brightest = 1.0;            ///< largest luminance by the mean
    double unevenness = 1.0;           ///< mean of the squared luminance by the square of the mean
    double top_share = 0.01;           ///< of all light, in the brightest hundredth of the sphere
    double sd = 0.0;                   ///< of the natural logarithm of luminance
    double skew = 0.0, kurtosis = 3.0; ///< of the same; 0 and 3 of a Gaussian
    double plateau_sr = 0.0;           ///< what is within a thousandth of the largest luminance

    /// Without anything bright and small, which gloss would show (largest by mean below 20, skew below 0).
    bool is_too_even_for_gloss() const { return brightest < 20.0 && skew < 0.0; }
    /// Brightest over more than thrice the sun's disc, all alike, and still no thousand times the mean: what
    /// a camera cuts off looks so. A window is no brighter than 100 times the mean, mostly.
    bool has_clipped_sun() const { return brightest > 100.0 && brightest < 1000.0 && plateau_sr > 2e-4; }
};

/// Of a probe that is not dark everywhere; else nothing.
std::optional<ProbeFacts> probe_facts(const LightProbe& probe);

/// A sentence with the five numbers.
std::string describe(const ProbeFacts& facts);

} // namespace overt
