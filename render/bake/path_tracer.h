/// Light along one path, from the surroundings to the eye.
#pragma once

#include <cstdint>

#include "render/bake/bake_scene.h"
#include "render/bake/sample_sequence.h"
#include "render/bake/spectral_light.h"

namespace overt {

struct SurfaceEvent;

/// Follows paths from the eye. The surface is asked for a direction, and what leaves the figure looks up the
/// light. Where the light has compact sources (SpectralLight::aim), each surface that scatters also sends a
/// path to one of them, and each path counts by the balance heuristic: its density of the sum of both (Veach
/// 1997, "Robust Monte Carlo Methods for Light Transport Simulation", 9.2). Under a broad sky no lamp is
/// aimed at.
class PathTracer {
  public:
    /// All must outlive the tracer. `turn`: see SpectralLight::share_of_turn. `world_from_object`: of an
    /// object that is not only turned about the vertical, which `turn` then knows nothing of; else null.
    PathTracer(const BakeScene& scene, const SpectralLight& light, float turn,
               const glm::mat3* world_from_object = nullptr)
        : scene_(&scene), light_(&light), turn_(turn), world_from_object_(world_from_object) {}

    /// Adds to `sum` the light that reaches the eye along a ray that meets the figure; gives false, adding
    /// nothing, if it misses the mesh itself. `sequence` has given its first two numbers for the place in the
    /// pixel.
    bool add_sample(const PathRay& from_eye, SampleSequence& sequence, Bins& sum);

    /// Rays cast so far.
    std::uint64_t rays() const { return rays_; }

  private:
    /// What a path through a coat is about.
    struct CoatedPath {
        PathRay ray;
        Bins carried;
        float set_out = 1.0f; ///< what it carried at first
        int layers = 0;       ///< of coat that it is in: where the coat passes through itself, more than one
        bool has_split = false;
    };

    /// Light from a surface that scatters towards the eye, by way of a source that is aimed at.
    void add_aimed(const SurfaceEvent& event, const SurfaceHit& hit, glm::vec3 surface_normal,
                   const Bins& carried, SampleSequence& sequence, Bins& sum);
    void follow(SurfaceHit hit, PathRay ray, SampleSequence& sequence, Bins& sum);
    void follow_coated(CoatedPath& path, SampleSequence sequence, Bins& sum);
    bool meet_coat(CoatedPath& path, const SurfaceHit& hit, SampleSequence& sequence, Bins& sum);

    /// A direction of the object's as the light has it.
    glm::vec3 in_light(glm::vec3 direction) const {
        return world_from_object_ ? *world_from_object_ * direction : direction;
    }
    glm::vec3 light_towards(glm::vec3 direction) const { return light_->towards(in_light(direction), turn_); }

    const BakeScene* scene_;
    const SpectralLight* light_;
    float turn_;
    const glm::mat3* world_from_object_;
    std::uint64_t rays_ = 0;
};

} // namespace overt
