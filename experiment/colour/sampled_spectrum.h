/// A spectrum as it is measured or tabulated: values at wavelengths, linear in between.
#pragma once

#include <vector>

namespace overt {

/// Radiance in W/(sr m2 nm), or a reflectance, or a sensitivity: whoever makes it says what. Wavelengths
/// rise.
struct SampledSpectrum {
    std::vector<double> wavelengths_nm;
    std::vector<double> values;

    double first_nm() const { return wavelengths_nm.front(); }
    double last_nm() const { return wavelengths_nm.back(); }

    /// Linear between its samples, 0 outside of them.
    double at(double wavelength_nm) const;
};

} // namespace overt
