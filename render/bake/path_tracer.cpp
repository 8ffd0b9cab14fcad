#include "render/bake/path_tracer.h"

#include <cmath>
#include <limits>

#include "render/bake/microfacets.h"

namespace overt {

namespace {

constexpr float no_limit = std::numeric_limits<float>::infinity();

/// A path that is still inside after so many events is given up; what is lost is far below a thousandth.
constexpr int most_events = 1024;

/// The shading normal, bent towards the eye until it faces it: at a silhouette the mean of the corners may
/// face away.
glm::vec3 facing(glm::vec3 normal, glm::vec3 to_eye) {
    constexpr float least = 1e-3f;
    const float cosine = glm::dot(normal, to_eye);
    return cosine >= least ? normal : glm::normalize(normal + (least - cosine) * to_eye);
}

/// A direction that a shading normal sends below the surface itself is mirrored back above it: nothing gets
/// lost and nothing leaks.
glm::vec3 above(glm::vec3 direction, glm::vec3 surface_normal) {
    constexpr float least = 1e-5f;
    const float height = glm::dot(direction, surface_normal);
    return height >= least
               ? direction
               : glm::normalize(direction + (2.0f * least - 2.0f * std::min(height, 0.0f)) * surface_normal);
}

/// Ends a path that carries little by chance, and lets it carry more if it goes on: right in the mean.
bool goes_on(Bins& carried, SampleSequence& sequence) {
    constexpr float little = 0.1f;
    const float most = carried.largest();
    if (most >= little)
        return true;
    const float chance = most / little;
    if (!(sequence.next() < chance))
        return false;
    scale(carried, 1.0f / chance);
    return true;
}

} // namespace

bool PathTracer::add_sample(const PathRay& from_eye, SampleSequence& sequence, Bins& sum) {
    ++rays_;
    const SurfaceHit hit = scene_->tree().first_hit(from_eye, no_limit, true);
    if (hit.surface < 0)
        return false;
    follow(hit, from_eye, sequence, sum);
    return true;
}

void PathTracer::follow(SurfaceHit hit, PathRay ray, SampleSequence& sequence, Bins& sum) {
    Bins carried = Bins::filled(1.0f);
    const float alpha = static_cast<float>(scene_->material().roughness);
    for (int event = 0; event < most_events; ++event) {
        glm::vec3 surface_normal = hit.triangle_normal, normal = hit.shading_normal;
        const bool from_behind = glm::dot(surface_normal, ray.direction) > 0.0f;
        if (from_behind) {
            surface_normal = -surface_normal;
            normal = -normal;
        }
        if (from_behind && scene_->is_closed()) {
            // Slipped in at an edge, by rounding: let it out again.
            ray.origin = hit.position - scene_->step_off() * surface_normal;
        } else {
            const glm::vec3 to_eye = -ray.direction;
            normal = facing(normal, to_eye);
            switch (scene_->kind()) {
            case MaterialKind::rough_conductor: {
                const NormalFrame frame(normal);
                const glm::vec3 micro =
                    frame.to_world(ggx_visible_normal(frame.to_local(to_eye), alpha, sequence.next_two()));
                const float cosine = glm::dot(to_eye, micro);
                const glm::vec3 out = 2.0f * cosine * micro - to_eye;
                const float visible = ggx_visible_share(frame.to_local(out), alpha);
                if (visible <= 0.0f)
                    return; // met another of the small mirrors: light of two of them is not followed
                scene_->metal().multiply_into(carried, cosine);
                scale(carried, visible);
                ray.direction = above(out, surface_normal);
                break;
            }
            case MaterialKind::diffuse:
                multiply(carried, scene_->reflectance());
                ray.direction = above(NormalFrame(normal).to_world(cosine_direction(sequence.next_two())),
                                      surface_normal);
                break;
            case MaterialKind::smooth_conductor:
            case MaterialKind::coated_conductor: {
                const float cosine = glm::dot(to_eye, normal);
                scene_->metal().multiply_into(carried, cosine);
                ray.direction = above(glm::normalize(2.0f * cosine * normal - to_eye), surface_normal);
                break;
            }
            }
            ray.origin = hit.position + scene_->step_off() * surface_normal;
            if (!goes_on(carried, sequence))
                return;
        }
        ++rays_;
        hit = scene_->tree().first_hit(ray, no_limit, false);
        if (hit.surface < 0) {
            add_lit(sum, carried, light_->basis(), light_->towards(ray.direction, turn_));
            return;
        }
    }
}

} // namespace overt
