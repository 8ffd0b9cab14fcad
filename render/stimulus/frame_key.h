/// Names for rendered frames and maps: hashes of everything that makes them.
#pragma once

#include <vector>

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

/// What a light's pictures are told apart by; its file is read once.
struct Surroundings {
    explicit Surroundings(const LightSettings& light);

    LightSettings light;
    ContentHash content;             ///< of the probe's file; its name if the program makes it
    std::vector<Surroundings> parts; ///< of a sum
};

/// Of the surroundings themselves, turned by so much from where their settings have them, without the
/// exposure. Throws InputError if the probe's file cannot be read.
ContentHash hash_of_surroundings(const Surroundings& surroundings, Degrees turn);

/// Of a path-traced stimulus in a view, but for the object's angle. The exposure is not in it, and frames
/// have none: they are the same for all exposures and displays; unless errors are judged, for which it
/// counts.
ContentHash traced_key(const Object& object, int view, const MaterialSettings& material,
                       const ContentHash& surroundings, double exposure, const BakeSettings& settings,
                       StandardObserver observer);

/// Of a stimulus that OpenGL draws under unturned surroundings, which it turns itself, likewise. The exposure
/// is in its frames.
ContentHash live_key(const Object& object, int view, const MaterialSettings& material,
                     const ContentHash& surroundings, Degrees turn, double exposure);

/// Of the maps of an object in a view, but for the angle. No light is in it.
ContentHash map_key(const Object& object, int view);

} // namespace overt
