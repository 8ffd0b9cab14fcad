/// Noise where a stimulus stands: a mask.
#pragma once

#include "render/presenter/screen_text.h"

namespace overt {

/// Squares of equal light, each drawn evenly between none and all of it, over the image's place; those at
/// the right and below are cut off. The same for the same seed and `place`, which counts what is covered.
PlacedPicture draw_noise(const Screen& screen, const ScreenGeometry& geometry, int place = 0);

} // namespace overt
