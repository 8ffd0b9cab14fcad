#include "experiment/colour/sampled_spectrum.h"

#include <algorithm>

namespace overt {

double SampledSpectrum::at(double wavelength_nm) const {
    if (values.empty() || !(wavelength_nm >= first_nm() && wavelength_nm <= last_nm()))
        return 0.0;
    const auto above = std::lower_bound(wavelengths_nm.begin(), wavelengths_nm.end(), wavelength_nm);
    const auto i = static_cast<std::size_t>(above - wavelengths_nm.begin());
    if (i == 0)
        return values.front();
    const double share =
        (wavelength_nm - wavelengths_nm[i - 1]) / (wavelengths_nm[i] - wavelengths_nm[i - 1]);
    return values[i - 1] + share * (values[i] - values[i - 1]);
}

} // namespace overt
