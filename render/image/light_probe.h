/// The light around the object: radiance from every direction, as a latitude-longitude picture.
#pragma once

#include <glm/glm.hpp>

#include "experiment/protocol/protocol.h"
#include "render/image/linear_image.h"

namespace overt {

/// Changes whenever the light of the same file is read differently: part of the key under which frames are
/// kept.
constexpr int probe_file_version = 2;

/// Rows run from zenith to nadir. A direction d of the world (+z up) stands at u = atan2(d.x, d.y) / 2 pi +
/// 1/2 of the width and v = acos(d.z) / pi of the height. Linear Rec.709; alpha unused.
struct LightProbe {
    LinearImage radiance;
    int negative_texels = 0; ///< that were found when it was read, and set to zero

    /// Bilinear, wrapping round horizontally. `direction` of unit length.
    glm::vec3 towards(glm::vec3 direction) const;
};

/// An overcast day in a city square: the CIE Standard Overcast Sky (CIE S 011: L = Lz (1 + 2 sin e) / 3), a
/// row of dark houses with lit windows along the horizon so that polished metal has something to mirror, and
/// a ground of albedo 0.2. Lz = 1.
LightProbe overcast_city_probe();

/// The protocol's probe: made here or read from its file, turned and with negative radiance (an artefact of
/// resampling) set to zero. Throws InputError if the file is no latitude-longitude picture (twice as wide as
/// high).
LightProbe load_light_probe(const LightSettings& light);

/// The probe as a GGX surface of roughness `alpha` mirrors it head-on: for each direction the mean over
/// visible micro-normals, with normal, view and mirror direction taken as one (Karis 2013). alpha 0 gives the
/// probe itself.
LightProbe blurred_by_ggx(const LightProbe& probe, double alpha, glm::ivec2 size_px);

/// Irradiance / pi on a surface facing each direction.
LightProbe irradiance_over_pi(const LightProbe& probe, glm::ivec2 size_px);

/// Smaller by whole factors, each texel the mean of those it covers.
LightProbe reduced(const LightProbe& probe, glm::ivec2 size_px);

} // namespace overt
