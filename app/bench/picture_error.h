/// How far a baked frame is from a better one of the same.
#pragma once

#include "render/bake/spectral_frame.h"

namespace overt {

struct PictureError {
    double srgb_psnr_db = 0.0;
    double mean_delta_e = 0.0; ///< CIE 1976
};

/// Of what an sRGB display shows, linear light cut to 0 … 1: over the pixels of the figure (alpha of the
/// reference at least 1/2), with the light times `exposure`.
PictureError picture_error(const SpectralFrame& frame, const SpectralFrame& reference, double exposure);

/// CIE XYZ of linear Rec. 709, against the white (1, 1, 1) of lab_of_xyz().
glm::dvec3 xyz_of_rec709(glm::dvec3 rgb);

/// Factor on a frame's light with which a share of the figure's pixels stays below 1 in all channels of
/// Rec.709.
double exposure_below_one(const SpectralFrame& frame, double share);

} // namespace overt
