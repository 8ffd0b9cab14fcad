#include "render/bake/light_colour.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "experiment/units.h"

namespace overt {

namespace {

/// D65 with Y = 1.
const Spectrum& white_light() {
    static const Spectrum white = [] {
        Spectrum light = illuminant_d65();
        double y = 0.0;
        for (std::size_t bin = 0; bin < spectral_bins; ++bin)
            y += cie1931_xyz()[1][bin] * light[bin];
        for (double& value : light)
            value /= y;
        return light;
    }();
    return white;
}

template <class Light> glm::dvec3 xyz_of(const Light& light) {
    glm::dvec3 xyz(0.0);
    for (std::size_t bin = 0; bin < spectral_bins; ++bin) {
        for (int axis = 0; axis < 3; ++axis)
            xyz[axis] += cie1931_xyz()[static_cast<std::size_t>(axis)][bin] * static_cast<double>(light[bin]);
    }
    return xyz;
}

/// By columns; IEC 61966-2-1.
const glm::dmat3 rec709_from_xyz{3.2406, -0.9689, 0.0557, -1.5372, 1.8758, -0.2040, -0.4986, 0.0415, 1.0570};

double logistic(double x) { return 1.0 / (1.0 + std::exp(-x)); }

Spectrum weighted(const std::array<Spectrum, 3>& bands, glm::dvec3 weights) {
    Spectrum sum{};
    for (std::size_t bin = 0; bin < spectral_bins; ++bin)
        sum[bin] = weights.x * bands[0][bin] + weights.y * bands[1][bin] + weights.z * bands[2][bin];
    return sum;
}

Spectrum under_white(Spectrum reflectance) {
    for (std::size_t bin = 0; bin < spectral_bins; ++bin)
        reflectance[bin] *= white_light()[bin];
    return reflectance;
}

/// How much of each band makes a colour under D65.
const glm::dmat3& bands_from_rec709() {
    static const glm::dmat3 matrix = [] {
        glm::dmat3 rec709_from_bands;
        for (int band = 0; band < 3; ++band) {
            rec709_from_bands[band] =
                rec709_of_xyz(xyz_of(under_white(absorbance_basis()[static_cast<std::size_t>(band)])));
        }
        return glm::inverse(rec709_from_bands);
    }();
    return matrix;
}

} // namespace

glm::dvec3 xyz_of_light(std::span<const float, spectral_bins> light) { return xyz_of(light); }

glm::dvec3 rec709_of_xyz(glm::dvec3 xyz) {
    static const glm::dvec3 white = rec709_from_xyz * xyz_of(white_light());
    return rec709_from_xyz * xyz / white;
}

glm::dvec3 lab_of_xyz(glm::dvec3 xyz) {
    static const glm::dvec3 white = xyz_of(white_light());
    const auto f = [](double t) {
        constexpr double knee = 216.0 / 24389.0; // CIE 15: (6/29)^3
        return t > knee ? std::cbrt(t) : (24389.0 / 27.0 * t + 16.0) / 116.0;
    };
    const double x = f(xyz.x / white.x), y = f(xyz.y / white.y), z = f(xyz.z / white.z);
    return {116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)};
}

double ciede2000(glm::dvec3 lab, glm::dvec3 other) {
    constexpr double turn = 360.0, seventh = 6103515625.0; // 25^7
    const auto power7 = [](double x) { return std::pow(x, 7.0); };
    const auto sine = [](double degrees) { return std::sin(to_radians({degrees}).value); };
    const auto cosine = [](double degrees) { return std::cos(to_radians({degrees}).value); };
    const double mean_chroma = 0.5 * (std::hypot(lab.y, lab.z) + std::hypot(other.y, other.z));
    const double stretch = 1.5 - 0.5 * std::sqrt(power7(mean_chroma) / (power7(mean_chroma) + seventh));
    const auto chroma = [&](glm::dvec3 of) { return std::hypot(stretch * of.y, of.z); };
    const auto hue = [&](glm::dvec3 of) {
        if (of.y == 0.0 && of.z == 0.0)
            return 0.0;
        const double degrees = std::atan2(of.z, stretch * of.y) * turn / (2.0 * std::numbers::pi);
        return degrees < 0.0 ? degrees + turn : degrees;
    };
    const double c1 = chroma(lab), c2 = chroma(other), h1 = hue(lab), h2 = hue(other);
    const bool has_hue = c1 * c2 > 0.0;
    double apart = has_hue ? h2 - h1 : 0.0;
    if (apart > 0.5 * turn)
        apart -= turn;
    else if (apart < -0.5 * turn)
        apart += turn;
    const double light = other.x - lab.x, colourful = c2 - c1,
                 across = 2.0 * std::sqrt(c1 * c2) * sine(0.5 * apart);
    double mean_hue = h1 + h2;
    if (has_hue) {
        mean_hue *= 0.5;
        if (std::abs(h1 - h2) > 0.5 * turn)
            mean_hue += h1 + h2 < turn ? 0.5 * turn : -0.5 * turn;
    }
    const double mean_light = 0.5 * (lab.x + other.x), mean_c = 0.5 * (c1 + c2);
    const double t = 1.0 - 0.17 * cosine(mean_hue - 30.0) + 0.24 * cosine(2.0 * mean_hue) +
                     0.32 * cosine(3.0 * mean_hue + 6.0) - 0.20 * cosine(4.0 * mean_hue - 63.0);
    const double from_blue = (mean_hue - 275.0) / 25.0;
    const double rotation = -sine(60.0 * std::exp(-from_blue * from_blue)) * 2.0 *
                            std::sqrt(power7(mean_c) / (power7(mean_c) + seventh));
    const double from_grey = (mean_light - 50.0) * (mean_light - 50.0);
    const double l = light / (1.0 + 0.015 * from_grey / std::sqrt(20.0 + from_grey)),
                 c = colourful / (1.0 + 0.045 * mean_c), h = across / (1.0 + 0.015 * mean_c * t);
    return std::sqrt(std::max(0.0, l * l + c * c + h * h + rotation * c * h));
}

const std::array<Spectrum, 3>& absorbance_basis() {
    static const std::array<Spectrum, 3> bands = [] {
        std::array<Spectrum, 3> made{};
        for (std::size_t bin = 0; bin < spectral_bins; ++bin) {
            const double wavelength_nm = first_bin_centre_nm + bin_width_nm * static_cast<double>(bin);
            const double red = logistic((wavelength_nm - 590.0) / 9.0);
            const double not_blue = logistic((wavelength_nm - 495.0) / 9.0);
            made[0][bin] = red;
            made[1][bin] = not_blue - red;
            made[2][bin] = 1.0 - not_blue;
        }
        return made;
    }();
    return bands;
}

const std::array<Spectrum, 3>& light_basis() {
    static const std::array<Spectrum, 3> basis = [] {
        std::array<Spectrum, 3> made{};
        for (int channel = 0; channel < 3; ++channel) {
            made[static_cast<std::size_t>(channel)] =
                under_white(weighted(absorbance_basis(), bands_from_rec709()[channel]));
        }
        return made;
    }();
    return basis;
}

const std::array<Spectrum, 3>& reflectance_basis() {
    static const std::array<Spectrum, 3> basis = [] {
        std::array<Spectrum, 3> made{};
        for (int channel = 0; channel < 3; ++channel)
            made[static_cast<std::size_t>(channel)] =
                weighted(absorbance_basis(), bands_from_rec709()[channel]);
        return made;
    }();
    return basis;
}

Spectrum absorbance_of(const std::array<double, 3>& rgb) {
    return weighted(absorbance_basis(), {rgb[0], rgb[1], rgb[2]});
}

Spectrum reflectance_of(const std::array<double, 3>& rec709) {
    const glm::dvec3 colour(rec709[0], rec709[1], rec709[2]);
    Spectrum reflectance = weighted(absorbance_basis(), bands_from_rec709() * colour);
    for (double& value : reflectance)
        value = std::clamp(value, 0.0, 1.0);
    return reflectance;
}

} // namespace overt
