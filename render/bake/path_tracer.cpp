#include "render/bake/path_tracer.h"

#include <cmath>
#include <limits>

#include "render/bake/bumps.h"
#include "render/bake/glass.h"
#include "render/bake/material_model.h"
#include "render/bake/own_surface.h"

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

constexpr float least_height = 1e-5f;

bool is_above(glm::vec3 direction, glm::vec3 surface_normal) {
    return glm::dot(direction, surface_normal) >= least_height;
}

/// A direction that a shading normal sends below the surface itself is mirrored back above it: nothing gets
/// lost and nothing leaks.
glm::vec3 above(glm::vec3 direction, glm::vec3 surface_normal) {
    const float height = glm::dot(direction, surface_normal);
    return height >= least_height
               ? direction
               : glm::normalize(direction +
                                (2.0f * least_height - 2.0f * std::min(height, 0.0f)) * surface_normal);
}

/// Ends a path that carries little of what it set out with by chance, and lets it carry more if it goes on:
/// right in the mean.
bool goes_on(Bins& carried, float set_out, SampleSequence& sequence) {
    const float little = 0.1f * set_out;
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
    if (scene_->has_coat()) {
        if (scene_->body_tree().first_distance(from_eye, true) < 0.0f)
            return false;
        CoatedPath path{from_eye, Bins::filled(1.0f)};
        follow_coated(path, sequence, sum);
        return true;
    }
    const SurfaceHit hit = scene_->tree().first_hit(from_eye, no_limit, true);
    if (hit.surface < 0)
        return false;
    if (scene_->glass()) {
        GlassPath path{from_eye, Bins::filled(1.0f)};
        follow_glass(path, hit, sequence, sum);
        return true;
    }
    follow(hit, from_eye, sequence, sum);
    return true;
}

void PathTracer::follow(SurfaceHit hit, PathRay ray, SampleSequence& sequence, Bins& sum) {
    Bins carried = Bins::filled(1.0f);
    const bool aims = light_->aim() != nullptr && scene_->model().density != nullptr;
    const bool aims_at_sources = !sources_.empty() && scene_->model().density != nullptr;
    const OwnSurface* const own = scene_->own();
    const Bumps* const bumps = scene_->bumps();
    OwnPoint point;
    // Density of the path's direction where it could have been aimed, too; 0: where not.
    float density = 0.0f;
    for (int event = 0; event < most_events; ++event) {
        glm::vec3 surface_normal = hit.triangle_normal,
                  normal = bumps ? bumps->normal_at(hit) : hit.shading_normal;
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
            SurfaceEvent surface{to_eye, facing(normal, to_eye)};
            if (own) {
                point = own->point(hit.triangle, hit.place);
                surface.point = &point;
            }
            if (aims)
                add_aimed(surface, hit, surface_normal, carried, sequence, sum);
            if (aims_at_sources)
                add_sources(surface, hit, surface_normal, carried, sequence, sum);
            const glm::vec3 onward = scene_->model().scatter(*scene_, surface, sequence, carried);
            if (onward == glm::vec3(0.0f))
                return;
            if (aims || aims_at_sources) {
                density = is_above(onward, surface_normal) ? scene_->model().density(*scene_, surface, onward)
                                                           : 0.0f;
            }
            ray.direction = above(onward, surface_normal);
            ray.origin = hit.position + scene_->step_off() * surface_normal;
            if (!goes_on(carried, 1.0f, sequence))
                return;
        }
        ++rays_;
        hit = scene_->tree().first_hit(ray, no_limit, false);
        if (!sources_.empty())
            add_met_sources(ray, hit.surface < 0 ? no_limit : hit.distance, density, carried, sum);
        if (hit.surface < 0) {
            glm::vec3 light = light_towards(ray.direction);
            if (aims && density > 0.0f)
                light *= density / (density + light_->aim()->density(in_light(ray.direction), turn_));
            add_lit(sum, carried, light_->basis(), light);
            return;
        }
    }
}

void PathTracer::add_aimed(const SurfaceEvent& event, const SurfaceHit& hit, glm::vec3 surface_normal,
                           const Bins& carried, SampleSequence& sequence, Bins& sum) {
    glm::vec3 direction = light_->aim()->direction(sequence.next_two(), turn_);
    if (world_from_object_)
        direction = direction * *world_from_object_; // by its transpose, which is its inverse
    if (!is_above(direction, surface_normal))
        return;
    // Its share of the sum of both densities, times what the surface passes on by its own.
    const float own = scene_->model().density(*scene_, event, direction);
    if (own <= 0.0f)
        return;
    const float share = own / (own + light_->aim()->density(in_light(direction), turn_));
    const glm::vec3 light = light_towards(direction);
    ++rays_;
    if (scene_->tree().first_distance({hit.position + scene_->step_off() * surface_normal, direction},
                                      false) >= 0.0f)
        return;
    Bins passed = carried;
    scene_->model().take(*scene_, event, direction, passed);
    add_lit(sum, passed, light_->basis(), share * light);
}

void PathTracer::add_sources(const SurfaceEvent& event, const SurfaceHit& hit, glm::vec3 surface_normal,
                             const Bins& carried, SampleSequence& sequence, Bins& sum) {
    const glm::vec3 from = hit.position + scene_->step_off() * surface_normal;
    for (const LightSource& source : sources_) {
        const LightSource::Aim aim = source.aim(from, sequence.next_two());
        if (!(aim.density > 0.0f) || !is_above(aim.direction, surface_normal))
            continue;
        const float own = scene_->model().density(*scene_, event, aim.direction);
        if (own <= 0.0f)
            continue;
        ++rays_;
        const float hidden_at = scene_->tree().first_distance({from, aim.direction}, false);
        if (hidden_at >= 0.0f && hidden_at < aim.distance)
            continue;
        Bins passed = carried;
        scene_->model().take(*scene_, event, aim.direction, passed);
        add_lit(sum, passed, light_->basis(), own / (own + aim.density) * source.light);
    }
}

void PathTracer::add_met_sources(const PathRay& ray, float distance, float density, const Bins& carried,
                                 Bins& sum) {
    for (const LightSource& source : sources_) {
        const float at = source.met_at(ray.origin, ray.direction);
        if (!(at > 0.0f && (at < distance || (at == no_limit && distance == no_limit))))
            continue;
        const float share =
            density > 0.0f ? density / (density + source.density(ray.origin, ray.direction, at)) : 1.0f;
        add_lit(sum, carried, light_->basis(), share * source.light);
    }
}

void PathTracer::follow_coated(CoatedPath& path, SampleSequence sequence, Bins& sum) {
    for (int event = 0; event < most_events; ++event) {
        ++rays_;
        const SurfaceHit hit = scene_->tree().first_hit(path.ray, no_limit, event == 0 && !path.has_split);
        if (!sources_.empty() && path.has_split) // the eye itself sees none
            add_met_sources(path.ray, hit.surface < 0 ? no_limit : hit.distance, 0.0f, path.carried, sum);
        if (hit.surface < 0) {
            add_lit(sum, path.carried, light_->basis(), light_towards(path.ray.direction));
            return;
        }
        if (path.layers > 0)
            absorb(path.carried, scene_->absorbance(), hit.distance);
        if (hit.surface == BakeScene::coat) {
            if (!meet_coat(path, hit, sequence, sum))
                return;
        } else if (glm::dot(hit.triangle_normal, path.ray.direction) > 0.0f) {
            // Slipped in at an edge, by rounding: let it out again.
            path.ray.origin = hit.position + scene_->step_off() * hit.triangle_normal;
        } else {
            const glm::vec3 to_eye = -path.ray.direction, normal = facing(hit.shading_normal, to_eye);
            const float cosine = glm::dot(to_eye, normal);
            scene_->metal().multiply_into(path.carried, cosine);
            path.ray.direction = above(glm::normalize(2.0f * cosine * normal - to_eye), hit.triangle_normal);
            path.ray.origin = hit.position + scene_->step_off() * hit.triangle_normal;
        }
        if (!goes_on(path.carried, path.set_out, sequence))
            return;
    }
}

void PathTracer::follow_glass(GlassPath& path, SurfaceHit hit, SampleSequence sequence, Bins& sum) {
    const Glass& glass = *scene_->glass();
    const bool scatters = scene_->medium() && scene_->medium()->scatters();
    for (int event = 0; event < most_events; ++event) {
        if (event > 0 || path.has_split) {
            if (scatters && path.is_inside) {
                if (!walk(path, hit, sequence))
                    return;
            } else {
                ++rays_;
                hit = scene_->tree().first_hit(path.ray, no_limit, false);
            }
            if (!sources_.empty())
                add_met_sources(path.ray, hit.surface < 0 ? no_limit : hit.distance, 0.0f, path.carried, sum);
            if (hit.surface < 0) {
                add_lit(sum, path.carried, light_->basis(), light_towards(path.ray.direction));
                return;
            }
        }
        const bool enters = glm::dot(hit.triangle_normal, path.ray.direction) < 0.0f;
        if (!enters)
            absorb(path.carried, scene_->absorbance(), hit.distance);
        const float side = enters ? 1.0f : -1.0f;
        const glm::vec3 surface_normal = side * hit.triangle_normal, to_eye = -path.ray.direction;
        const auto take = [&](GlassPath& along, GlassTurn turn, SampleSequence& numbers) {
            const GlassWay way = glass.meet(to_eye, facing(side * hit.shading_normal, to_eye), surface_normal,
                                            enters, along.band, turn, numbers);
            multiply(along.carried, way.carried);
            const glm::vec3 outward = way.goes_through ? -surface_normal : surface_normal;
            along.ray = {hit.position + scene_->step_off() * outward, above(way.direction, outward)};
            if (way.band != along.band) // one colour stands for all from here on
                along.set_out *= static_cast<float>(spectral_bins);
            along.band = way.band;
            along.is_inside = way.goes_through == enters;
        };
        if (!path.has_split) {
            // Both ways once, at the first meeting, as for a coat.
            path.has_split = true;
            GlassPath mirrored = path;
            SampleSequence numbers = sequence;
            take(mirrored, GlassTurn::mirrored, numbers);
            mirrored.set_out = mirrored.carried.largest();
            if (mirrored.set_out > 0.0f)
                follow_glass(mirrored, hit, numbers, sum);
            take(path, GlassTurn::let_through, sequence);
        } else {
            take(path, GlassTurn::by_chance, sequence);
        }
        if (!(path.carried.largest() > 0.0f) || !goes_on(path.carried, path.set_out, sequence))
            return;
    }
}

bool PathTracer::meet_coat(CoatedPath& path, const SurfaceHit& hit, SampleSequence& sequence, Bins& sum) {
    const bool enters = glm::dot(hit.triangle_normal, path.ray.direction) < 0.0f;
    const float side = enters ? 1.0f : -1.0f;
    const glm::vec3 surface_normal = side * hit.triangle_normal;
    const int layers_beyond = path.layers + (enters ? 1 : -1);
    const glm::vec3 before = hit.position + scene_->step_off() * surface_normal;
    const glm::vec3 beyond = hit.position - scene_->step_off() * surface_normal;
    if ((path.layers > 0) == (layers_beyond > 0)) {
        // Coat on both sides, or air: no surface, only the coat passing through itself.
        path.layers = layers_beyond;
        path.ray.origin = beyond;
        return true;
    }
    const glm::vec3 to_eye = -path.ray.direction;
    glm::vec3 normal = facing(side * hit.shading_normal, to_eye);
    const auto ior =
        static_cast<float>(enters ? scene_->material().coat_ior : 1.0 / scene_->material().coat_ior);
    glm::vec3 inward = glm::refract(path.ray.direction, normal, 1.0f / ior);
    if (inward != glm::vec3(0.0f) && glm::dot(inward, surface_normal) > -1e-5f) {
        // The shading normal would send it back: then the triangle's own normal has the say.
        normal = surface_normal;
        inward = glm::refract(path.ray.direction, normal, 1.0f / ior);
    }
    const float cosine = std::min(1.0f, glm::dot(normal, to_eye));
    const float reflected = dielectric_fresnel(ior, cosine);
    const PathRay back{before, above(glm::normalize(2.0f * cosine * normal - to_eye), surface_normal)};
    if (!path.has_split) {
        // Both ways once, at the first meeting: which of the two shows is most of what chance would bring
        // into the picture.
        path.has_split = true;
        CoatedPath mirrored = path;
        mirrored.ray = back;
        scale(mirrored.carried, reflected);
        mirrored.set_out = reflected;
        follow_coated(mirrored, sequence, sum);
        scale(path.carried, 1.0f - reflected);
    } else if (sequence.next() < reflected) {
        path.ray = back;
        return true;
    }
    if (reflected >= 1.0f)
        return false;
    path.ray = {beyond, glm::normalize(inward)};
    path.layers = layers_beyond;
    return true;
}

} // namespace overt
