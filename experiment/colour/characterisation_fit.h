/// From readings of a photometer to a display's characterisation, and how well it foretells other readings.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "experiment/colour/display_characterisation.h"

namespace overt {

/// What a photometer saw of a patch.
struct PatchReading {
    glm::dvec3 signal{0.0}; ///< red, green, blue, 0 … 1, as it was sent
    glm::dvec3 xyz{0.0};    ///< CIE 1931, Y in cd/m2
};

/// Which curves a characterisation takes: the measured points, or the power fitted to them.
enum class CurveModel { table, power };

struct ChannelFit {
    ChannelCurve table;     ///< the means of the readings; where they fell, made level
    ChannelCurve power;     ///< gain, offset and exponent by least squares of relative errors
    double gain = 1.0;      ///< of the power, against the reading at full signal
    double power_rms = 0.0; ///< of the power from the points, as share of full light
    int levels = 0;         ///< at which the channel alone was read
    int levelled = 0;       ///< points that noise had put below darker ones
    /// How far x and y of the channel alone wander from those at full signal where it has at least a tenth of
    /// its light.
    double chromaticity_drift = 0.0;
};

struct CharacterisationFit {
    DisplayCharacterisation display; ///< light and curves only
    std::array<ChannelFit, 3> channels;
    int readings = 0, patches = 0; ///< different signals
    double repeat_noise =
        0.0; ///< standard deviation of a luminance among readings of one patch, as share of it
};

/// Fits black, the channels at full signal, and their curves to the readings in which at most one channel is
/// lit; all others only serve for validation. Throws InputError naming what is lacking: black, a channel at
/// full signal, or four of its levels in between.
CharacterisationFit fit_characterisation(std::span<const PatchReading> readings, CurveModel model);

/// How far readings in which several channels are lit are from what the model says.
struct CharacterisationCheck {
    int patches = 0; ///< 0: there were none, and nothing is known
    // Over patches with at least 1 % of white's luminance.
    double luminance_mean = 0.0, luminance_worst = 0.0; ///< as share of the patch's own luminance
    double xy_mean = 0.0, xy_worst = 0.0;               ///< the larger of the errors of x and y
    glm::dvec3 worst_signal{0.0};                       ///< of the luminance
    /// Luminance of white against the sum of the channels, as share of white; nothing if white was not read.
    std::optional<double> additivity;
    /// How much a channel's step of light changes when the others are lit, as share of white's luminance; the
    /// largest. Nothing if there is no such step among the readings.
    std::optional<double> dependence;
};
CharacterisationCheck check_characterisation(const DisplayCharacterisation& display,
                                             std::span<const PatchReading> readings);

} // namespace overt
