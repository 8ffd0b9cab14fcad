/// A path's way through what scatters light.
#include <bit>
#include <limits>

#include "render/bake/glass.h"
#include "render/bake/path_tracer.h"

namespace overt {

namespace {

/// A path that was scattered so often is given up, and counted (PathTracer::given_up): of a body without
/// absorption that is a thousand mean flights across, some 1e-5 of the light is left then.
constexpr int most_scatterings = 1 << 20;

/// Ends a walk that carries little of what it set out with by chance, and lets it carry more if it goes on.
bool walks_on(Bins& carried, float set_out, WalkNumbers& numbers) {
    const float little = 0.1f * set_out, most = carried.largest();
    if (most >= little)
        return true;
    if (!(numbers.next() * little < most))
        return false;
    scale(carried, little / most);
    return true;
}

} // namespace

bool PathTracer::walk(GlassPath& path, SurfaceHit& hit, SampleSequence& sequence) {
    const Medium& medium = *scene_->medium();
    MediumPath& state = path.medium;
    // The first flight and where it turns are spread evenly over a pixel's paths, as what was before.
    bool is_spread = false;
    if (state.band < 0) {
        const float number = sequence.next();
        const std::uint64_t high = std::bit_cast<std::uint32_t>(sequence.next());
        medium.enter(state, number, high << 32 | std::bit_cast<std::uint32_t>(sequence.next()));
        is_spread = true;
    }
    const float far_squared = 1.02f * scene_->radius() * scene_->radius();
    while (true) {
        const float flight = medium.free_path(state.band, is_spread ? sequence.next() : state.numbers.next());
        ++rays_;
        hit = scene_->tree().first_hit(path.ray, flight, false);
        if (hit.surface >= 0) {
            // A front that is met from outside: it slipped out at an edge, by rounding.
            if (glm::dot(hit.triangle_normal, path.ray.direction) >= 0.0f)
                medium.fly(hit.distance, state, path.carried);
            return true;
        }
        const glm::vec3 place = path.ray.origin + flight * path.ray.direction;
        if (!(glm::dot(place, place) < far_squared))
            return true; // out of a hole in the mesh
        path.ray.origin = place;
        medium.scatter_after(flight, state, path.carried);
        const glm::vec2 turn =
            is_spread ? sequence.next_two() : glm::vec2{state.numbers.next(), state.numbers.next()};
        path.ray.direction = medium.onward(path.ray.direction, turn);
        is_spread = false;
        if (!(path.carried.largest() > 0.0f) || !walks_on(path.carried, path.set_out, state.numbers))
            return false;
        if (state.scatterings >= most_scatterings) {
            for (std::size_t bin = 0; bin < spectral_bins; ++bin)
                given_up_ += static_cast<double>(path.carried.value[bin]) / spectral_bins;
            return false;
        }
    }
}

} // namespace overt
