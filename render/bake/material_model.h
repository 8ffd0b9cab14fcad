/// What the renderers make of each kind of material. What else there is to know of a kind is in its row of
/// experiment/protocol/material_kind.h.
#pragma once

#include "experiment/protocol/protocol.h"
#include "render/bake/sample_sequence.h"
#include "render/bake/spectral_bins.h"
#include "render/image/light_probe.h"

namespace overt {

class BakeScene;
class ConductorTable;
class LayeredSurface;
struct OwnPoint;

/// Where a path from the eye meets a surface, seen from its front.
struct SurfaceEvent {
    glm::vec3 to_eye{0.0f};
    glm::vec3 normal{0.0f};          ///< for shading; faces the eye
    const OwnPoint* point = nullptr; ///< what is there, of a surface that is not the same everywhere
};

/// What the shader of live frames is told (stimulus.frag).
struct LiveApproximation {
    enum class Shading : std::uint8_t { metal, coated_metal, matt, plastic } shading;
    /// The probe as this material mirrors it.
    LightProbe (*mirrored)(const LightProbe& probe, const MaterialSettings& material);
    /// Half-angle in radians over which it gathers light.
    float (*lobe_radius)(const MaterialSettings& material);
};

struct MaterialModel {
    /// Gives the direction in which a path goes on from a surface, and takes from `carried` what the surface
    /// does not send on; (0, 0, 0) ends the path. Null: the
    /// path goes into what is met, a coat, glass or what is translucent (PathTracer).
    glm::vec3 (*scatter)(const BakeScene& scene, const SurfaceEvent& event, SampleSequence& sequence,
                         Bins& carried);

    /// Of a surface that scatters: with what density per solid angle scatter() gives a direction of unit
    /// length, and what it then takes from `carried`. Null: it gives one direction alone, at which no light
    /// can be aimed.
    float (*density)(const BakeScene& scene, const SurfaceEvent& event, glm::vec3 onward);
    void (*take)(const BakeScene& scene, const SurfaceEvent& event, glm::vec3 onward, Bins& carried);

    /// Makes what a layered surface is of, once for a stimulus; null: it is none. `reflectance` and `metal`:
    /// of BakeScene.
    LayeredSurface (*layers)(const MaterialSettings& material, const Bins& reflectance,
                             const ConductorTable& metal);

    bool scatters;    ///< no two samples go the same way: a picture needs more of them
    double path_cost; ///< time of a path, that of a smooth metal being 1
    LiveApproximation live;
};

/// The model of a kind: defined once for each, in material_….cpp. A kind without one does not link.
template <MaterialKind kind> const MaterialModel& material_model();

const MaterialModel& model_of(MaterialKind kind);

/// The same, but of a rough metal that is brushed, or has all light between its mirrors or a clear coat, the
/// one that has that, and of a material with base = own that of `own`, whose surface then is as the kind has
/// it (OwnSurface).
const MaterialModel& model_of(const MaterialSettings& material);

/// What a layered kind's model consists of, but for its cost and its live approximation.
MaterialModel layered_model();

} // namespace overt
