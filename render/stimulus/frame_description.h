/// What made a frame, in words that go with it.
#pragma once

#include <span>

#include "experiment/stimulus/object.h"
#include "render/image/linear_image.h"
#include "render/stimulus/frame_quality.h"

namespace overt {

/// Object, material, camera, angle, and the surroundings as they are turned, without their exposure.
ImageAttributes describe_stimulus(const Protocol& protocol, std::span<const Object> objects,
                                  const Stimulus& stimulus, const Pose& pose);

/// Quality, samples, filter, seed, observer and the tracer's version.
ImageAttributes describe_tracing(const FrameQuality& quality, const Protocol& protocol,
                                 MaterialKind material);

} // namespace overt
