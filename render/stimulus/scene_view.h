/// The one matrix with which every pass draws an object.
#pragma once

#include "experiment/scene/viewing.h"

namespace overt {

/// From positions about the bounds' centre to clip space, with the image's top row first in memory: the
/// framebuffers of this program are read and shown in that order, and only a window turns it round. Throws
/// InputError as depth_range does.
glm::mat4 clip_from_centred_object(const SceneView& scene, const ObjectPose& object);

} // namespace overt
