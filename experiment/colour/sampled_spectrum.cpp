#include "experiment/colour/sampled_spectrum.h"

#include <algorithm>

#include "experiment/base/error.h"

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

SampledSpectrum sampled(double first_nm, double step_nm, std::vector<double> values) {
    OVERT_EXPECTS(step_nm > 0.0);
    SampledSpectrum spectrum{{}, std::move(values)};
    for (std::size_t i = 0; i < spectrum.values.size(); ++i)
        spectrum.wavelengths_nm.push_back(first_nm + step_nm * static_cast<double>(i));
    return spectrum;
}

SampledSpectrum product(const SampledSpectrum& a, const SampledSpectrum& b) {
    SampledSpectrum both;
    if (a.values.empty() || b.values.empty())
        return both;
    std::merge(a.wavelengths_nm.begin(), a.wavelengths_nm.end(), b.wavelengths_nm.begin(),
               b.wavelengths_nm.end(), std::back_inserter(both.wavelengths_nm));
    const double first = std::max(a.first_nm(), b.first_nm()), last = std::min(a.last_nm(), b.last_nm());
    std::erase_if(both.wavelengths_nm, [&](double nm) { return nm < first || nm > last; });
    both.wavelengths_nm.erase(std::unique(both.wavelengths_nm.begin(), both.wavelengths_nm.end()),
                              both.wavelengths_nm.end());
    for (const double nm : both.wavelengths_nm)
        both.values.push_back(a.at(nm) * b.at(nm));
    return both;
}

} // namespace overt
