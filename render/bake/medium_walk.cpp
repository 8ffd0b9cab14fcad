/// A path's way through what scatters light.
#include <algorithm>
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

/// A ball about a place that no surface is in: flights within it need no ray. Which of them are asked for is
/// only a matter of time, and changes no path.
class ClearBall {
  public:
    ClearBall(const SurfaceTree& tree, float margin, float mean_flight)
        : tree_(&tree), margin_(margin), mean_flight_(mean_flight) {}

    /// Of the end of a flight that began in it.
    bool holds(glm::vec3 place) const {
        const glm::vec3 from = place - middle_;
        return glm::dot(from, from) < radius_ * radius_;
    }
    /// A ray to `place` has met nothing: after some of these, and where it came out of a ball, another ball
    /// may pay.
    void leave_to(glm::vec3 place) {
        constexpr int patience = 8;
        constexpr float least_flights = 3.0f, most_flights = 32.0f;
        const bool had_one = radius_ > 0.0f;
        radius_ = 0.0f;
        if (!had_one && ++rays_ < patience)
            return;
        rays_ = 0;
        const float clear = tree_->clearance(place, most_flights * mean_flight_) - margin_;
        if (clear < least_flights * mean_flight_)
            return;
        middle_ = place;
        radius_ = clear;
    }

  private:
    const SurfaceTree* tree_;
    float margin_, mean_flight_, radius_ = 0.0f;
    glm::vec3 middle_{0.0f};
    int rays_ = 0;
};

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
    ClearBall clear(scene_->tree(), 4.0f * scene_->step_off(), medium.mean_flight(state.band));
    // What it carries is asked for after 1, 2, 4, 8, 16, 32 … scatterings.
    constexpr int most_unsettled = 16;
    while (true) {
        const float flight = medium.free_path(state.band, is_spread ? sequence.next() : state.numbers.next());
        const glm::vec3 place = path.ray.origin + flight * path.ray.direction;
        if (!clear.holds(place)) {
            ++rays_;
            hit = scene_->tree().first_hit(path.ray, flight, false);
            if (hit.surface >= 0) {
                // A front that is met from outside: it slipped out at an edge, by rounding.
                if (glm::dot(hit.triangle_normal, path.ray.direction) >= 0.0f)
                    medium.fly(hit.distance, state);
                medium.settle(state, path.carried);
                return true;
            }
            if (!(glm::dot(place, place) < far_squared))
                break; // out of a hole in the mesh
            clear.leave_to(place);
        }
        path.ray.origin = place;
        medium.scatter_after(flight, state);
        const glm::vec2 turn =
            is_spread ? sequence.next_two() : glm::vec2{state.numbers.next(), state.numbers.next()};
        path.ray.direction = medium.onward(path.ray.direction, turn);
        is_spread = false;
        if (state.unsettled < std::min(most_unsettled, state.scatterings - state.unsettled))
            continue;
        medium.settle(state, path.carried);
        if (!(path.carried.largest() > 0.0f) || !walks_on(path.carried, path.set_out, state.numbers))
            return false;
        if (state.scatterings >= most_scatterings) {
            for (std::size_t bin = 0; bin < spectral_bins; ++bin)
                given_up_ += static_cast<double>(path.carried.value[bin]) / spectral_bins;
            return false;
        }
    }
    medium.settle(state, path.carried);
    return true;
}

} // namespace overt
