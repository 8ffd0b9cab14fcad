#include "render/stimulus/observed_colours.h"

#include "experiment/base/parallel.h"
#include "experiment/colour/colour_matching.h"
#include "render/bake/light_colour.h"

namespace overt {

namespace {

using MatchingBins = std::array<glm::dvec3, spectral_bins>;

/// XYZ_F of each bin's light, that of D65 with Y = 1 having Y_F = 1.
const MatchingBins& cie2006_bins() {
    static const MatchingBins bins = [] {
        const auto& functions = colour_matching(ColourSpace::cie2006_xyz);
        MatchingBins means{};
        double white = 0.0;
        for (std::size_t bin = 0; bin < spectral_bins; ++bin) {
            const double centre_nm = first_bin_centre_nm + bin_width_nm * static_cast<double>(bin);
            constexpr int steps = 10;
            for (int axis = 0; axis < 3; ++axis) {
                for (int step = 0; step < steps; ++step) {
                    const double at_nm = centre_nm + bin_width_nm * ((step + 0.5) / steps - 0.5);
                    means[bin][axis] += functions[static_cast<std::size_t>(axis)].at(at_nm) / steps;
                }
            }
            for (const Spectrum& channel : light_basis())
                white += means[bin].y * channel[bin];
        }
        for (glm::dvec3& mean : means)
            mean /= white;
        return means;
    }();
    return bins;
}

} // namespace

LinearImage seen_by(StandardObserver observer, const SpectralFrame& frame) {
    if (observer == StandardObserver::cie1931)
        return to_rec709(frame);
    LinearImage picture(frame.size_px);
    const MatchingBins& bins = cie2006_bins();
    parallel_for(frame.size_px.y, [&](int row) {
        const auto width = static_cast<std::size_t>(frame.size_px.x);
        for (std::size_t i = static_cast<std::size_t>(row) * width;
             i < (static_cast<std::size_t>(row) + 1) * width; ++i) {
            glm::dvec3 xyz(0.0);
            for (std::size_t bin = 0; bin < spectral_bins; ++bin)
                xyz += bins[bin] * static_cast<double>(frame.radiance[i * spectral_bins + bin]);
            const float alpha = frame.alpha[i];
            picture.pixels[i] = glm::vec4(glm::vec3(xyz) * alpha, alpha);
        }
    });
    return picture;
}

} // namespace overt
