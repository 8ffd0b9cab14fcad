#include "devices/simulated/simulated_turns.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "experiment/base/random.h"
#include "experiment/ports/recorded_key_press.h"

namespace overt {

namespace {

constexpr double pause_log_sd = 0.5;
constexpr double move_interval_s = 1.0 / 60.0;
/// With the mouse, which has no speed of its own.
constexpr double drag_speed_deg_s = 60.0;

} // namespace

void SimulatedTurns::clear() noexcept {
    planned_.clear();
    next_ = 0;
}

void SimulatedTurns::plan(std::uint64_t seed, const Trial& trial, const TurningOffer& offer) {
    RandomStream random(
        seed, fmt::format("{} {} {}", offer.is_elevation ? "elevations" : "turns", offer.show, offer.place),
        static_cast<std::uint64_t>(trial.index));
    RandomStream tilts(seed, fmt::format("tilts {} {}", offer.show, offer.place),
                       static_cast<std::uint64_t>(trial.index));
    planned_.erase(planned_.begin(), planned_.begin() + static_cast<std::ptrdiff_t>(next_));
    next_ = 0;
    ObserverInput input;
    input.device = ShortName(simulated_observer_device);
    const auto add = [&](ObserverInput::Kind kind, double at_s) {
        input.kind = kind;
        input.at = offer.since + from_seconds(at_s);
        planned_.push_back(input);
    };
    const bool by_keys = !offer.less.empty() && !offer.more.empty();
    const double speed_deg_s = by_keys ? offer.speed_deg_s : drag_speed_deg_s;
    for (double at_s = 0.0;;) {
        at_s += offer.pause_s * std::exp(pause_log_sd * random.normal());
        const double turn_deg = offer.turn_sd_deg * random.normal();
        // A drag goes aslant where it may, as far to the side as without.
        const double tilt_deg = offer.drags_tilt ? offer.turn_sd_deg * tilts.normal() : 0.0;
        const double way_deg = std::hypot(turn_deg, tilt_deg);
        const double end_s = at_s + way_deg / speed_deg_s;
        if (end_s >= offer.lasts_s)
            break;
        if (by_keys) {
            input.key = ShortName(turn_deg < 0.0 ? offer.less : offer.more);
            add(ObserverInput::Kind::key_down, at_s);
            add(ObserverInput::Kind::key_up, end_s);
        } else {
            input.button = 1;
            input.right_px = offer.right_px;
            input.down_px = offer.down_px;
            add(ObserverInput::Kind::pointer_down, at_s);
            for (double on_s = move_interval_s; at_s + on_s < end_s; on_s += move_interval_s) {
                const double share = speed_deg_s * on_s / way_deg;
                input.right_px = offer.right_px + share * turn_deg / offer.deg_per_px;
                input.down_px = offer.down_px + share * tilt_deg / offer.deg_per_px;
                add(ObserverInput::Kind::pointer_moved, at_s + on_s);
            }
            input.right_px = offer.right_px + turn_deg / offer.deg_per_px;
            input.down_px = offer.down_px + tilt_deg / offer.deg_per_px;
            add(ObserverInput::Kind::pointer_moved, end_s);
            add(ObserverInput::Kind::pointer_up, end_s);
        }
        at_s = end_s;
    }
    std::ranges::stable_sort(planned_, {}, &ObserverInput::at);
}

std::optional<ObserverInput> SimulatedTurns::next(SessionTime now) noexcept {
    if (next_ >= planned_.size() || planned_[next_].at > now)
        return std::nullopt;
    return planned_[next_++];
}

} // namespace overt
