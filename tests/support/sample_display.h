/// A characterised display for tests: three channels of unlike curves, a black that is some light.
#pragma once

#include <cmath>

#include "experiment/colour/display_characterisation.h"

namespace overt::test {

/// A spectrum of equally spaced samples.
inline SampledSpectrum sampled(double first_nm, double step_nm, std::vector<double> values) {
    SampledSpectrum spectrum{{}, std::move(values)};
    for (std::size_t i = 0; i < spectrum.values.size(); ++i)
        spectrum.wavelengths_nm.push_back(first_nm + step_nm * static_cast<double>(i));
    return spectrum;
}

/// A curve of `points` equally spaced signals of a power function with a shoulder.
inline ChannelCurve shouldered_curve(int points, double exponent, double shoulder) {
    std::vector<double> signals, lights;
    for (int i = 0; i < points; ++i) {
        const double s = static_cast<double>(i) / (points - 1);
        signals.push_back(s);
        lights.push_back(std::pow(s, exponent) * (1.0 + shoulder * s * (1.0 - s)));
    }
    lights.back() = 1.0;
    return ChannelCurve::table(signals, lights, exponent);
}

inline DisplayCharacterisation sample_display() {
    DisplayCharacterisation display;
    display.display = "a display for tests";
    display.date = "2026-03-05";
    display.instrument = "none";
    display.black_xyz = {0.11, 0.12, 0.19};
    display.primaries_xyz = {glm::dvec3(46.0, 24.0, 2.1), glm::dvec3(34.0, 76.0, 11.5),
                             glm::dvec3(20.0, 8.5, 105.0)};
    display.curves = {shouldered_curve(17, 2.35, 0.2), shouldered_curve(12, 2.1, -0.15),
                      ChannelCurve::power(1.9, -0.04)};
    return display;
}

} // namespace overt::test
