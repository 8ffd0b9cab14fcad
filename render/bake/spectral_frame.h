/// A picture with 31 bins of light in each pixel.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "render/image/linear_image.h"

namespace overt {

/// Top row first. Light is measured so that D65 with Y = 1 is (1, 1, 1) of Rec.709; the protocol's exposure
/// is not yet in it.
struct SpectralFrame {
    glm::ivec2 size_px{0};
    /// 31 for each pixel: mean over those of its samples that met the mesh; 0 where none did.
    std::vector<float> radiance;
    /// Share of each pixel's samples that met the mesh itself, whatever coat is on it. It is at least 1/2
    /// exactly where the map of triangles has one at the pixel's middle: where area and middle disagree,
    /// alpha is moved to 1/2 or to just below it.
    std::vector<float> alpha;
    std::vector<std::uint16_t> samples; ///< that each pixel got; 0: background
    std::vector<float> error_de;        ///< estimated Delta-E ab of each pixel; empty without target_error_de
    std::size_t alphas_moved = 0;       ///< pixels whose alpha was moved as said
    double rays = 0.0;                  ///< cast for it
    /// Share of its paths' light that was given up inside a translucent body, after very many scatterings: as
    /// much is missing in the mean, in light of 1 from everywhere.
    double given_up = 0.0;
    bool is_complete = false; ///< false: it was stopped, and its content is of no use
};

/// CIE 1931 XYZ and alpha, not multiplied by it.
LinearImage to_xyz(const SpectralFrame& frame);

/// Linear Rec.709 times `exposure`, multiplied by alpha as a StimulusRenderer gives it. Channels may be
/// negative or above 1.
LinearImage to_rec709(const SpectralFrame& frame, double exposure = 1.0);

} // namespace overt
