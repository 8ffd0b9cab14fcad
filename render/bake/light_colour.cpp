#include "render/bake/light_colour.h"

#include <algorithm>
#include <cmath>

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
