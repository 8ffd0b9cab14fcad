/// Light along one path, from the surroundings to the eye.
#pragma once

#include <cstdint>
#include <span>

#include "render/bake/bake_scene.h"
#include "render/bake/medium.h"
#include "render/bake/sample_sequence.h"
#include "render/bake/spectral_light.h"

namespace overt {

struct SurfaceEvent;

/// Follows paths from the eye. The surface is asked for a direction, and what leaves the figure looks up the
/// light. Where the light has compact sources (SpectralLight::aim), each surface that scatters also sends a
/// path to one of them, and each path counts by the balance heuristic: its density of the sum of both (Veach
/// 1997, "Robust Monte Carlo Methods for Light Transport Simulation", 9.2). Under a broad sky no direction of
/// it is aimed at. The sun and lamps near the object are aimed at each for itself, and seen in what mirrors.
class PathTracer {
  public:
    /// All must outlive the tracer. `turn`: see SpectralLight::share_of_turn. `world_from_object`: of an
    /// object that is not only turned about the vertical, which `turn` then knows nothing of; else null.
    /// `sources`: SpectralLight::sources_at.
    PathTracer(const BakeScene& scene, const SpectralLight& light, float turn,
               const glm::mat3* world_from_object = nullptr, std::span<const LightSource> sources = {})
        : scene_(&scene), light_(&light), turn_(turn), world_from_object_(world_from_object),
          sources_(sources) {}

    /// Adds to `sum` the light that reaches the eye along a ray that meets the figure; gives false, adding
    /// nothing, if it misses the mesh itself. `sequence` has given its first two numbers for the place in the
    /// pixel.
    bool add_sample(const PathRay& from_eye, SampleSequence& sequence, Bins& sum);

    /// Rays cast so far.
    std::uint64_t rays() const { return rays_; }
    /// Paths of which each 1 is one whole path's light, that were given up after very many scatterings.
    double given_up() const { return given_up_; }

  private:
    /// What a path through a coat is about.
    struct CoatedPath {
        PathRay ray;
        Bins carried;
        float set_out = 1.0f; ///< what it carried at first
        int layers = 0;       ///< of coat that it is in: where the coat passes through itself, more than one
        bool has_split = false;
    };

    /// What a path through glass is about, or through a translucent body.
    struct GlassPath {
        PathRay ray;
        Bins carried;
        float set_out = 1.0f; ///< as of CoatedPath
        int band = -1;        ///< the only one that it still carries, once colours have parted
        bool has_split = false;
        bool is_inside = false; ///< of the body, in its medium
        MediumPath medium{};
    };

    /// Light from a surface that scatters towards the eye, by way of a source that is aimed at.
    void add_aimed(const SurfaceEvent& event, const SurfaceHit& hit, glm::vec3 surface_normal,
                   const Bins& carried, SampleSequence& sequence, Bins& sum);
    /// The same by way of the sun and each lamp, which are aimed at where the surface scatters.
    void add_sources(const SurfaceEvent& event, const SurfaceHit& hit, glm::vec3 surface_normal,
                     const Bins& carried, SampleSequence& sequence, Bins& sum);
    /// What shines along a ray before it meets something at `distance`. `density`: of its direction, where
    /// that could have been aimed, too; 0: where not.
    void add_met_sources(const PathRay& ray, float distance, float density, const Bins& carried, Bins& sum);
    void follow(SurfaceHit hit, PathRay ray, SampleSequence& sequence, Bins& sum);
    void follow_coated(CoatedPath& path, SampleSequence sequence, Bins& sum);
    /// `hit`: where the path is at first; of one that has split already, where that was.
    void follow_glass(GlassPath& path, SurfaceHit hit, SampleSequence sequence, Bins& sum);
    /// From scattering to scattering through the body's medium until the path meets its border: false: it has
    /// ended inside. No surface is met where the mesh has a hole.
    bool walk(GlassPath& path, SurfaceHit& hit, SampleSequence& sequence);
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
    std::span<const LightSource> sources_;
    std::uint64_t rays_ = 0;
    double given_up_ = 0.0;
};

} // namespace overt
