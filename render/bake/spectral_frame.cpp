#include "render/bake/spectral_frame.h"

#include <span>

#include "render/bake/light_colour.h"

namespace overt {

namespace {

template <class Colour> LinearImage picture_of(const SpectralFrame& frame, const Colour& colour) {
    LinearImage picture(frame.size_px);
    for (std::size_t pixel = 0; pixel < picture.pixels.size(); ++pixel) {
        if (frame.alpha[pixel] > 0.0f) {
            const std::span<const float, spectral_bins> light(&frame.radiance[pixel * spectral_bins],
                                                              spectral_bins);
            picture.pixels[pixel] = colour(xyz_of_light(light), frame.alpha[pixel]);
        }
    }
    return picture;
}

} // namespace

LinearImage to_xyz(const SpectralFrame& frame) {
    return picture_of(frame, [](glm::dvec3 xyz, float alpha) { return glm::vec4(glm::vec3(xyz), alpha); });
}

LinearImage to_rec709(const SpectralFrame& frame, double exposure) {
    return picture_of(frame, [&](glm::dvec3 xyz, float alpha) {
        return glm::vec4(glm::vec3(exposure * static_cast<double>(alpha) * rec709_of_xyz(xyz)), alpha);
    });
}

} // namespace overt
