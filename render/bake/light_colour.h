/// Between 31 bins of light and colours, exactly there and back.
///
/// Light is measured so that D65 with Y = 1 is the white of linear Rec.709, (1, 1, 1).
#pragma once

#include <array>
#include <span>

#include <glm/glm.hpp>

#include "experiment/spectra/spectra.h"

namespace overt {

/// CIE 1931 XYZ of light.
glm::dvec3 xyz_of_light(std::span<const float, spectral_bins> light);

/// Linear Rec.709 of XYZ; a channel may be negative or exceed 1. D65 is (1, 1, 1) to the last digit: the
/// matrix of IEC 61966-2-1 and, channel by channel, what its rounding and 31 coarse bins leave.
glm::dvec3 rec709_of_xyz(glm::dvec3 xyz);

/// CIE 1976 L*a*b* of XYZ against the white (1, 1, 1) of Rec.709. Nothing is cut off: L* may exceed 100.
glm::dvec3 lab_of_xyz(glm::dvec3 xyz);

/// CIEDE2000 colour difference of two L*a*b* colours, with all factors 1 (CIE 142-2001; Sharma, Wu & Dalal
/// 2005, "The CIEDE2000 color-difference formula", whose pairs tests demand).
double ciede2000(glm::dvec3 lab, glm::dvec3 other);

/// Light of the colours (1, 0, 0), (0, 1, 0) and (0, 0, 1): three bands that share the spectrum, with soft
/// edges at 495 and 590 nm (logistic, 9 nm), times D65, mixed so that each sum of them has the colour that it
/// was made from. White gives D65 itself. Since it is linear, a probe may be filtered before or after. A bin
/// of a pure colour may be slightly negative.
const std::array<Spectrum, 3>& light_basis();

/// The same bands without D65 and without mixing: how a filter's absorbance in red, green and blue is meant
/// over the spectrum. They add to 1 in each bin.
const std::array<Spectrum, 3>& absorbance_basis();

/// Absorbance (optical depth) given in red, green and blue, over the spectrum.
Spectrum absorbance_of(const std::array<double, 3>& rgb);

/// Reflectances of the colours (1, 0, 0), (0, 1, 0) and (0, 0, 1) under D65: sums of them have the colour
/// that they are made of. A bin may be negative or exceed 1.
const std::array<Spectrum, 3>& reflectance_basis();

/// Reflectance whose colour under D65 is the given one; cut to 0 … 1 in each bin.
Spectrum reflectance_of(const std::array<double, 3>& rec709);

} // namespace overt
