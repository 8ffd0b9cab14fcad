/// Spectra on 31 bins of 10 nm, 395 to 705 nm, as in Sidorov et al. (2019), and the colours that come of
/// them.
#pragma once

#include <array>
#include <string_view>

#include <glm/glm.hpp>

namespace overt {

inline constexpr int spectral_bins = 31;
inline constexpr double first_bin_centre_nm = 400.0;
inline constexpr double bin_width_nm = 10.0;

/// One value per bin: the mean over it.
using Spectrum = std::array<double, spectral_bins>;

/// A metal's complex refractive index.
struct ComplexIndex {
    Spectrum n{};
    Spectrum k{};
};

/// "Au" (gold) or "Ag" (silver). Throws InputError for another, naming these. Source: assets/README.md.
const ComplexIndex& metal_index(std::string_view metal);

/// CIE 1931 2-degree colour matching functions.
const std::array<Spectrum, 3>& cie1931_xyz();
/// Standard illuminant D65, relative.
const Spectrum& illuminant_d65();

/// Reflectance at normal incidence seen from a medium of index `outside` (air: 1): ((n - m)^2 + k^2) / ((n +
/// m)^2 + k^2).
Spectrum normal_reflectance(const ComplexIndex& metal, double outside);

/// Colour of a reflectance under D65 in linear Rec.709, where a perfect white is (1, 1, 1). A channel may
/// exceed 1.
glm::dvec3 linear_rec709_of(const Spectrum& reflectance);

} // namespace overt
