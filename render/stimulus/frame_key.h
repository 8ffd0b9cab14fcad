/// Names for rendered frames and maps: hashes of everything that makes them.
#pragma once

#include "experiment/base/content_hash.h"
#include "experiment/stimulus/object.h"
#include "render/bake/bake_settings.h"

namespace overt {

/// Changes whenever the same inputs would give other maps.
constexpr int coordinate_pass_version = 1;

// Each adds all that the thing has and the light of a frame depends on: a member added to it has to be added
// here, or this does not compile.
void add_to(ContentHasher& hasher, const SceneView& scene);
void add_to(ContentHasher& hasher, const MaterialSettings& material);
void add_to(ContentHasher& hasher, const BakeSettings& settings);

/// Of the surroundings themselves, without the exposure. Throws InputError if the probe's file cannot be
/// read.
ContentHash hash_of_surroundings(const LightSettings& light);

/// Of a path-traced stimulus, but for the angle. The exposure is not in it, and frames have none: they are
/// the same for all exposures and displays; unless errors are judged, for which it counts.
ContentHash traced_key(const Object& object, const MaterialSettings& material,
                       const ContentHash& surroundings, double exposure, const BakeSettings& settings,
                       StandardObserver observer);

/// Of a stimulus that OpenGL draws, likewise. The exposure is in its frames.
ContentHash live_key(const Object& object, const MaterialSettings& material, const ContentHash& surroundings,
                     double exposure);

/// Of the maps of an object.
ContentHash map_key(const Object& object);

} // namespace overt
