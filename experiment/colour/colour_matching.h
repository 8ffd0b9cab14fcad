/// From spectra to the three numbers that an observer makes of them.
#pragma once

#include <array>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "experiment/base/enum_names.h"
#include "experiment/colour/sampled_spectrum.h"

namespace overt {

/// What the three numbers are. Tables and their sources: assets/README.md.
enum class ColourSpace {
    cie1931_xyz,  ///< 2-degree standard observer of 1931; Y in cd/m2
    cie2006_xyz,  ///< XYZ_F of CIE 170-2:2015, 2 degrees; Y_F in cd/m2
    cie2006_cones ///< L, M, S cone excitations by the 2-degree fundamentals of CIE 2006, each with its
                  ///< highest value 1: W/(sr m2)
};
template <>
inline constexpr auto names_of<ColourSpace> = enum_names<ColourSpace>("CIE 1931 XYZ", "CIE 2006 XYZ_F",
                                                                      "CIE 2006 LMS");

/// The three functions of a space, at each nanometre. Made once; from any thread.
const std::array<SampledSpectrum, 3>& colour_matching(ColourSpace space);

/// Integral of a radiance in W/(sr m2 nm) with the space's functions over the wavelengths at which both are
/// known, by trapezoids of 1 nm (CIE 015:2018, 7.1); of XYZ multiplied by 683 lm/W.
glm::dvec3 tristimulus_of(const SampledSpectrum& radiance, ColourSpace space);

/// x and y of XYZ; (0, 0) of no light.
glm::dvec2 chromaticity_of(const glm::dvec3& xyz);

} // namespace overt
