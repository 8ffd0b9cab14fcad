/// A spectral frame as an observer sees it.
#pragma once

#include "experiment/protocol/protocol.h"
#include "render/bake/spectral_frame.h"
#include "render/image/linear_image.h"

namespace overt {

/// In rendered_colours(observer), multiplied by alpha, without exposure: D65 with Y = 1 is white with Y = 1
/// for either observer.
LinearImage seen_by(StandardObserver observer, const SpectralFrame& frame);

} // namespace overt
