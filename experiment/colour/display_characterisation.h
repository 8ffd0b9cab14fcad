/// What is known of a display: the light that it makes of a signal, measured. The model is the usual one of
/// independent channels that add up (Brainard, Pelli & Robson 2002, "Display characterization", in:
/// Encyclopedia of Imaging Science and Technology):
///     XYZ(signal) = black + sum over channels of curve(signal of channel) * (channel at full signal - black)
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "experiment/base/content_hash.h"
#include "experiment/colour/channel_curve.h"
#include "experiment/colour/colour_matching.h"

namespace overt {

/// Radiance of the three channels at full signal and of black, in W/(sr m2 nm).
struct PrimarySpectra {
    std::array<SampledSpectrum, 3> channels; ///< red, green, blue; without the black
    SampledSpectrum black;                   ///< without values: no light
};

/// The screen that was measured, as far as the file says it; compared with the protocol's.
struct MeasuredScreen {
    std::optional<int> width_px, height_px;
    std::optional<double> refresh_hz, width_mm, height_mm, viewing_distance_mm;
};

/// A file that a characterisation was read from: the TOML, or a table beside it.
struct CharacterisationFile {
    std::string name; ///< without its folder
    std::string text;
};

struct DisplayCharacterisation {
    std::string display;    ///< which display, in words
    std::string date;       ///< of the measurement
    std::string instrument; ///< in words
    std::string note;
    MeasuredScreen screen;
    glm::dvec3 black_xyz{0.0};                    ///< CIE 1931, Y in cd/m2
    std::array<glm::dvec3, 3> primaries_xyz{};    ///< of the channels at full signal, without the black
    std::optional<glm::dvec3> measured_white_xyz; ///< with the black, as it was measured
    std::array<ChannelCurve, 3> curves;           ///< red, green, blue
    std::optional<PrimarySpectra> spectra;        ///< if the file gives them
    std::vector<CharacterisationFile> files;      ///< empty if it was not read from files
    ContentHash sha256;                           ///< of `files`; empty likewise

    /// Full signal in all channels, by the model: black and primaries added up.
    glm::dvec3 white_xyz() const;

    /// Luminance in cd/m2 of a grey of this linear light, 0 … 1 from black to white; and back.
    double luminance_of(double linear) const;
    double linear_of(double luminance_cd_m2) const;

    /// White's luminance over that of black; infinite for a display whose black is none.
    double contrast() const;

    /// Each channel's share of the luminance between black and white; sum 1.
    glm::dvec3 luminance_shares() const;

    /// Light of the three channels at a signal, 0 … 1 each.
    glm::dvec3 linear_of_signal(const glm::dvec3& signal) const;

    /// XYZ in cd/m2 at a signal.
    glm::dvec3 xyz_of_signal(const glm::dvec3& signal) const;
};

/// XYZ of linear light of 1 in red, green and blue, in the columns; black is not in it.
glm::dmat3 primary_matrix(const std::array<glm::dvec3, 3>& primaries);

/// How far three primaries are from lying in one plane: 1 over the condition number of their matrix, each
/// primary brought to length 1 (in the Frobenius norm). Displays have 0.1 … 0.3; 0 has no inverse.
double independence_of(const std::array<glm::dvec3, 3>& primaries);
inline constexpr double least_independence = 1e-3; ///< below this a matrix is taken to have no inverse

} // namespace overt
