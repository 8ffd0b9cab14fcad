/// A frame of a stimulus, computed as light goes.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "experiment/scene/viewing.h"
#include "render/bake/bake_scene.h"
#include "render/bake/bake_settings.h"
#include "render/bake/spectral_frame.h"
#include "render/bake/spectral_light.h"

namespace overt {

/// Changes whenever the same inputs would give other light: part of the key under which frames are kept.
constexpr int frame_baker_version = 2;

/// The same for surroundings in which paths may be aimed (SpectralLight::aim): all but the overcast sky.
constexpr int aimed_paths_version = 1;

/// Told now and then which share of a frame is done, 0 … 1, by one thread at a time; answers whether to go
/// on.
using BakeProgress = std::function<bool(double share_done)>;

/// Bakes one frame on all processors. `covered`: 1 where the map of triangles has one at the pixel's middle,
/// row by row; a pixel is traced if it or one of its eight neighbours is covered. The light is that of the
/// mesh as `object` stands in `view`, whose size is that of `covered`. The result depends on nothing but the
/// arguments: not on threads, their number or their order. Throws InputError for impossible settings.
SpectralFrame bake_frame(const BakeScene& scene, const SpectralLight& light, const SceneView& view,
                         const ObjectPose& object, std::span<const std::uint8_t> covered,
                         const BakeSettings& settings, const BakeProgress& progress = {});

/// What `covered` would be if nobody else drew it: whether the ray through each pixel's middle meets the
/// mesh.
std::vector<std::uint8_t> covered_pixels(const BakeScene& scene, const SceneView& view,
                                         const ObjectPose& object);

} // namespace overt
