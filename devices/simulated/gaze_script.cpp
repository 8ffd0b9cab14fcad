#include "devices/simulated/gaze_script.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "devices/simulated/eye_movements.h"
#include "experiment/base/error.h"
#include "experiment/events/main_sequence.h"

namespace overt {

namespace {

/// How long the script goes on after the planned end: refreshes can be late, and the eye stays a moment.
constexpr SessionDuration afterwards = std::chrono::seconds(2);

constexpr int draws_of_a_region = 200;

/// Time from the object's appearance to the first saccade.
constexpr double reaction_median_s = 0.2, reaction_log_sd = 0.2, reaction_low_s = 0.12, reaction_high_s = 0.4;

/// Spread of fixations on a picture of which only the image is known, as share of its size.
constexpr double image_spread = 0.15;

/// Composes one script: what the steps below share.
struct Composer {
    const ObservedScene& scene;
    std::span<const ObservedPresentation> shown;
    const ObserverSettings& settings;
    RandomStream random;
    RandomStream which; ///< of the things shown

    ScreenPoint place(const ScriptedFixation& fixation, SessionDuration since_onset) const {
        return place_of(fixation, since_onset, shown);
    }

    /// Where and when a fixation ends: what all targets on one thing that may follow it have in common.
    struct Departure {
        SessionDuration at{};
        ScreenPoint place;
        glm::dmat4 world_from_object{1.0}; ///< then, in the middle of the screen
    };
    Departure departure_of(const ScriptedFixation& before, const ObservedPresentation& on) const {
        Departure departure{before.end, place(before, before.end)};
        if (on.targets)
            departure.world_from_object = on.targets->world_from_object(
                on.turn->angle_at(before.end - scene.light_delay(scene.screen.centre().y_px)));
        return departure;
    }

    /// Sets the begin after a saccade from there, and the end. Gives the saccade's size.
    Degrees follow(const Departure& before, ScriptedFixation& next, double duration_s) const {
        if (next.target) {
            const ObservedPresentation& on = shown[next.shown];
            const glm::dvec2 image = on.targets->project(next.target->position, before.world_from_object);
            next.light_delay = scene.light_delay(on.screen.screen_from_image(image).y_px);
        }
        const Degrees amplitude = scene.screen.angle_between(before.place, place(next, before.at));
        next.begin = before.at + saccade_duration(amplitude);
        next.end = next.begin + from_seconds(duration_s);
        return amplitude;
    }

    bool stays_visible(const ScriptedFixation& fixation, SessionDuration from) const {
        const ObservedPresentation& on = shown[fixation.shown];
        const int last = on.turn->step_at(fixation.end - fixation.light_delay);
        for (int step = on.turn->step_at(from - fixation.light_delay); step <= last; ++step) {
            if (!on.targets->is_visible(*fixation.target, on.turn->motion(), step))
                return false;
        }
        return true;
    }

    /// `draw_one()` draws a point. If none is far enough, the farthest of those that stay visible is taken:
    /// going elsewhere instead would make the shares of small regions smaller than planned.
    template <class Draw>
    bool find_target(const Departure& before, ScriptedFixation& next, double duration_s,
                     const Draw& draw_one) {
        std::optional<SurfacePoint> farthest;
        Degrees so_far{0.0};
        for (int draw = 0; draw < draws_of_a_region; ++draw) {
            next.target = draw_one();
            const Degrees amplitude = follow(before, next, duration_s);
            if (amplitude < so_far || !stays_visible(next, before.at))
                continue;
            if (amplitude >= settings.shortest_saccade)
                return true;
            farthest = next.target;
            so_far = amplitude;
        }
        if (!farthest)
            return false;
        next.target = farthest;
        follow(before, next, duration_s);
        return true;
    }

    bool find_target(const Departure& before, ScriptedFixation& next, double duration_s, std::size_t region) {
        const ObservedPresentation& on = shown[next.shown];
        return find_target(before, next, duration_s,
                           [&] { return on.targets->draw(random, region, on.plan.spread); });
    }

    /// The effect to whose spot a fixation goes; -1: to none.
    int choose_spot(const GazePlan& plan) {
        if (plan.spot_count == 0)
            return -1;
        double chance = random.uniform();
        for (const GazePlan::Spot& spot :
             std::span(plan.spots.data(), static_cast<std::size_t>(plan.spot_count))) {
            if (chance < spot.share)
                return spot.effect;
            chance -= spot.share;
        }
        return -1;
    }

    /// An area of the scene, or elsewhere.
    std::size_t choose_region(const GazePlan& plan) {
        double chance = random.uniform();
        std::size_t area = 0;
        for (; area < plan.area_count && chance >= plan.shares[area]; ++area)
            chance -= plan.shares[area];
        return area;
    }

    std::size_t choose_shown() {
        double all = 0.0;
        bool is_alike = true;
        for (const ObservedPresentation& one : shown) {
            all += one.weight;
            is_alike = is_alike && one.weight == shown.front().weight;
        }
        if (is_alike)
            return which.below(static_cast<std::uint32_t>(shown.size()));
        double chance = all * which.uniform();
        std::size_t chosen = 0;
        for (; chosen + 1 < shown.size() && chance >= shown[chosen].weight; ++chosen)
            chance -= shown[chosen].weight;
        return chosen;
    }

    bool find_in_another(const Departure& before, ScriptedFixation& next, double duration_s,
                         std::size_t region) {
        for (std::size_t other = shown[next.shown].targets->elsewhere() + 1; other-- > 0;) {
            if (other != region && find_target(before, next, duration_s, other))
                return true;
        }
        return false;
    }

    ScriptedFixation next_fixation(const ScriptedFixation& last) {
        ScriptedFixation next;
        next.shown = choose_shown();
        const auto& [targets, screen, plan, turn, seen, slot, weight] = shown[next.shown];
        const Departure before = departure_of(last, shown[next.shown]);
        const double duration_s =
            log_normal_within(random, settings.fixation_median_s, settings.fixation_log_sd,
                              settings.shortest_fixation_s, settings.longest_fixation_s);
        const int spot = choose_spot(plan);
        const std::size_t region = choose_region(plan);
        if (targets) {
            const bool found_spot = spot >= 0 && find_target(before, next, duration_s, [&, on = targets] {
                                        return on->draw_from_spot(random, spot);
                                    });
            if (found_spot || find_target(before, next, duration_s, region) ||
                find_in_another(before, next, duration_s, region))
                return next;
            next.target.reset();
            next.place = scene.screen.centre();
        } else {
            const glm::dvec2 size(screen.image_px);
            const glm::dvec2 image(size.x * (0.5 + image_spread * random.normal()),
                                   size.y * (0.5 + image_spread * random.normal()));
            next.place = screen.screen_from_image(glm::clamp(image, glm::dvec2(0.0), size - 1.0));
        }
        follow(before, next, duration_s);
        return next;
    }
};

} // namespace

PursuedTurn::PursuedTurn(const ObservedScene& scene, int motion)
    : frame_period_(scene.frame_period(motion)), steps_(scene.animation_of(motion).shown_frame_count()),
      motion_(motion) {
    OVERT_EXPECTS(steps_ > 0);
    const Animation& animation = scene.animation_of(motion);
    for (int step = 0; step < animation.steps_per_period(); ++step)
        angles_.push_back(animation.object_in(animation.frame_at_step(step)));
    if (!animation.has_plan())
        only_step_ =
            animation.kind == MotionKind::observer ? animation.by_observer.nearest(animation.angle) : 0;
}

std::vector<PursuedTurn> turns_of(const ObservedScene& scene) {
    std::vector<PursuedTurn> turns;
    for (int motion = 0; motion < static_cast<int>(scene.animations.size()); ++motion)
        turns.emplace_back(scene, motion);
    return turns;
}

ObjectPose PursuedTurn::angle_at(SessionDuration since_lit) const noexcept {
    if (only_step_)
        return angle_of_step(*only_step_);
    const double steps = to_seconds(since_lit) / to_seconds(frame_period_) - 0.5;
    const double place = std::clamp(steps, 0.0, steps_ - 1.0);
    const int before = static_cast<int>(place);
    const double share = place - before;
    return between(angle_of_step(before), angle_of_step(before + 1), share);
}

int PursuedTurn::step_at(SessionDuration since_lit) const noexcept {
    if (only_step_)
        return *only_step_;
    const auto step = static_cast<int>(since_lit / frame_period_);
    return std::clamp(step, 0, steps_ - 1);
}

GazeScript::GazeScript(const ObservedScene& scene, const ObserverSettings& settings)
    : horizon_(from_seconds(scene.longest_s()) + afterwards) {
    const double shortest_s =
        settings.shortest_fixation_s + to_seconds(saccade_duration(Degrees{0.0})) + 1e-3;
    fixations_.reserve(static_cast<std::size_t>(to_seconds(horizon_) / shortest_s) + 2);
}

void GazeScript::compose(const ObservedScene& scene, std::span<const ObservedPresentation> shown,
                         const ObserverSettings& settings, std::uint64_t seed, int trial) noexcept {
    const auto number = static_cast<std::uint64_t>(trial);
    Composer composer{scene, shown, settings, RandomStream(seed, "scanpath", number),
                      RandomStream(seed, "slot of fixation", number)};
    fixations_.clear();
    ScriptedFixation first;
    first.place = scene.screen.centre();
    first.end = from_seconds(log_normal_within(composer.random, reaction_median_s, reaction_log_sd,
                                               reaction_low_s, reaction_high_s));
    fixations_.push_back(first);
    while (fixations_.back().end < horizon_ && fixations_.size() < fixations_.capacity())
        fixations_.push_back(composer.next_fixation(fixations_.back()));
}

std::size_t GazeScript::fixation_at(SessionDuration since_onset) const noexcept {
    // The fixation whose saccade away from the one before has not begun later than this.
    const auto next = std::ranges::upper_bound(fixations_, since_onset, {}, &ScriptedFixation::begin);
    return next == fixations_.begin() ? 0 : static_cast<std::size_t>(next - fixations_.begin() - 1);
}

int script_number(int trial, int show) {
    constexpr int most_trials = 1 << 20;
    return trial + most_trials * show;
}

namespace {

/// How the object of a fixation's target is turned, as the eye pursues it.
glm::dmat4 pursued(const ScriptedFixation& fixation, SessionDuration since_onset,
                   const ObservedPresentation& on) noexcept {
    const SessionDuration since_lit = since_onset - fixation.light_delay;
    return on.targets->world_from_object(on.seen ? on.seen->angle_at(since_lit)
                                                 : on.turn->angle_at(since_lit));
}

} // namespace

double other_eye_right_px(const ScriptedFixation& fixation, SessionDuration since_onset,
                          std::span<const ObservedPresentation> shown) noexcept {
    if (!fixation.target)
        return 0.0;
    const ObservedPresentation& on = shown[fixation.shown];
    return on.targets->other_eye_right_px(fixation.target->position, pursued(fixation, since_onset, on));
}

ScreenPoint place_of(const ScriptedFixation& fixation, SessionDuration since_onset,
                     std::span<const ObservedPresentation> shown) noexcept {
    if (!fixation.target)
        return fixation.place;
    const ObservedPresentation& on = shown[fixation.shown];
    return on.screen.screen_from_image(
        on.targets->project(fixation.target->position, pursued(fixation, since_onset, on)));
}

ScreenPoint place_of(const ScriptedFixation& fixation, SessionDuration since_onset,
                     const ObservedScene& scene, const GazeTargets* targets,
                     const PursuedTurn& turn) noexcept {
    const ObservedPresentation only{targets, scene.screen, {}, &turn};
    return place_of(fixation, since_onset, {&only, 1});
}

} // namespace overt
