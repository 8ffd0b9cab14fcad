/// How well a frame is to be baked.
#pragma once

#include <cstdint>

#include "experiment/protocol/protocol.h"

namespace overt {

struct BakeSettings {
    int samples = 64; ///< of each pixel, 1 … 65536; powers of two are spread best
    /// A pixel gets no more samples once its error (CIE 1976 Delta-E ab of the light times the light's
    /// exposure, one standard deviation) is estimated to be below this; `samples` is then the most. 0: all
    /// get `samples`.
    double target_error_de = 0.0;
    PixelFilter filter = PixelFilter::box;
    double filter_width_px = 1.0; ///< of the whole filter, 0 … 3; 0: all samples through the pixel's middle
    int pixel_step =
        1; ///< 2: squares of 2 x 2 pixels share their samples, and the light between them is interpolated
    std::uint64_t seed = 0; ///< another seed: other noise
    int most_threads = 0;   ///< 0: as many as the machine has processors. The result is the same
};

/// Samples and step of a quality: preview 4 at half the resolution, draft 16, standard 64 (256 where the
/// noise of a rough or matt surface needs them), reference 256. Not of `live`, which is not baked.
BakeSettings settings_of(BakeQuality quality, MaterialKind material);

} // namespace overt
