#include "app/bench/picture_error.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "render/bake/light_colour.h"

namespace overt {

namespace {

/// IEC 61966-2-1.
double srgb_of(double v) { return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1.0 / 2.4) - 0.055; }

} // namespace

glm::dvec3 xyz_of_rec709(glm::dvec3 rgb) {
    static const glm::dmat3 matrix = glm::inverse(glm::dmat3(
        rec709_of_xyz({1.0, 0.0, 0.0}), rec709_of_xyz({0.0, 1.0, 0.0}), rec709_of_xyz({0.0, 0.0, 1.0})));
    return matrix * rgb;
}

PictureError picture_error(const SpectralFrame& frame, const SpectralFrame& reference, double exposure) {
    const LinearImage ours = to_xyz(frame), better = to_xyz(reference);
    double squares = 0.0, delta_e = 0.0, count = 0.0;
    for (std::size_t pixel = 0; pixel < ours.pixels.size(); ++pixel) {
        if (reference.alpha[pixel] < 0.5f)
            continue;
        // What an sRGB display shows of it.
        const auto shown = [&](const LinearImage& image) {
            const double scale = exposure * static_cast<double>(image.pixels[pixel].w);
            return glm::clamp(rec709_of_xyz(scale * glm::dvec3(image.pixels[pixel])), 0.0, 1.0);
        };
        const glm::dvec3 one = shown(ours), other = shown(better);
        for (int channel = 0; channel < 3; ++channel) {
            const double difference = srgb_of(one[channel]) - srgb_of(other[channel]);
            squares += difference * difference / 3.0;
        }
        delta_e += glm::distance(lab_of_xyz(xyz_of_rec709(one)), lab_of_xyz(xyz_of_rec709(other)));
        count += 1.0;
    }
    return {-10.0 * std::log10(squares / count), delta_e / count};
}

double exposure_below_one(const SpectralFrame& frame, double share) {
    const LinearImage picture = to_rec709(frame);
    std::vector<float> largest;
    for (const glm::vec4& pixel : picture.pixels) {
        if (pixel.a >= 0.5f)
            largest.push_back(std::max({pixel.x, pixel.y, pixel.z}));
    }
    if (largest.empty())
        return 1.0;
    const auto at =
        largest.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(largest.size() - 1));
    std::nth_element(largest.begin(), at, largest.end());
    return 1.0 / static_cast<double>(std::max(*at, 1e-6f));
}

} // namespace overt
