#include "experiment/session/object_turning.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "experiment/base/random.h"

namespace overt {

namespace {

/// A mouse that tells a thousand places a second is kept for as many seconds at least.
constexpr std::size_t most_turning_inputs = 16384;

} // namespace

void ObjectTurning::begin_trial(const Protocol& protocol, const Trial& trial, std::uint64_t seed,
                                bool is_practice) {
    turned_.clear();
    taken_.clear();
    lost_inputs_ = 0;
    for (std::size_t i = 0; i < trial.shown_count(); ++i) {
        const PlacedStimulus shown = trial.shown(i);
        const MotionSettings& motion = protocol.motion_of(shown.stimulus);
        if (motion.kind != MotionKind::observer)
            continue;
        const Slot& slot = protocol.slots[static_cast<std::size_t>(shown.slot)];
        const ScreenGeometry screen = slot_geometry(protocol, slot);
        Turned& turned = turned_.emplace_back();
        turned.motion = &motion;
        turned.place = static_cast<int>(i);
        turned.slot = slot.id;
        turned.left_px = screen.image_origin_px.x - 0.5 * screen.screen_px.x;
        turned.top_px = screen.image_origin_px.y - 0.5 * screen.screen_px.y;
        turned.width_px = screen.image_px.x;
        turned.height_px = screen.image_px.y;
        int pose = motion.by_observer.nearest(motion.angle);
        if (motion.by_observer.start == TurnStart::drawn) {
            RandomStream stream(seed, fmt::format("{}pose {}", is_practice ? "practice " : "", i),
                                static_cast<std::uint64_t>(trial.index));
            pose =
                static_cast<int>(stream.below(static_cast<std::uint32_t>(motion.by_observer.pose_count())));
        }
        turned.angle_deg = motion.by_observer.angle_of(pose).value;
    }
    if (!turned_.empty())
        taken_.reserve(most_turning_inputs);
}

void ObjectTurning::begin_show(const std::vector<int>& places) {
    for (Turned& turned : turned_) {
        turned.is_lit = std::ranges::find(places, turned.place) != places.end();
        turned.is_less_held = turned.is_more_held = turned.is_dragged = false;
    }
}

void ObjectTurning::end_show() noexcept {
    for (Turned& turned : turned_)
        turned.is_lit = turned.is_less_held = turned.is_more_held = turned.is_dragged = false;
}

bool ObjectTurning::is_active() const noexcept { return std::ranges::any_of(turned_, &Turned::is_lit); }

bool ObjectTurning::shows_pointer() const noexcept {
    return std::ranges::any_of(turned_,
                               [](const Turned& turned) { return turned.is_lit && turned.by_mouse(); });
}

std::vector<TurningOffer> ObjectTurning::offers(int show, SessionTime since, double lasts_s) const {
    std::vector<TurningOffer> offers;
    for (const Turned& turned : turned_) {
        if (!turned.is_lit)
            continue;
        TurningOffer& offer = offers.emplace_back();
        offer.show = show;
        offer.place = turned.place;
        offer.since = since;
        offer.lasts_s = lasts_s;
        if (turned.by_keys()) {
            offer.less = turned.by().keys.front();
            offer.more = turned.by().keys.back();
        }
        offer.speed_deg_s = turned.by().speed_deg_s;
        offer.deg_per_px = turned.deg_per_px();
        offer.right_px = turned.left_px + 0.5 * turned.width_px;
        offer.down_px = turned.top_px + 0.5 * turned.height_px;
        offer.turn_sd_deg = turned.by().simulated_turn_deg;
        offer.pause_s = turned.by().simulated_pause_s;
    }
    return offers;
}

bool ObjectTurning::Turned::is_at(double right_px, double down_px) const {
    return right_px >= left_px && right_px < left_px + width_px && down_px >= top_px &&
           down_px < top_px + height_px;
}

/// Where it can be turned all round the angle goes on, else it stays at the ends.
double ObjectTurning::Turned::within(double deg) const {
    return by().is_whole() ? deg
                           : std::clamp(deg, by().from.value, by().angle_of(by().pose_count() - 1).value);
}

/// Time may go back by as much as an input came late.
void ObjectTurning::Turned::go_to(SessionTime now) noexcept {
    if (is_less_held != is_more_held)
        angle_deg =
            within(from_deg + (is_more_held ? 1.0 : -1.0) * by().speed_deg_s * to_seconds(now - since));
}

/// From now on held keys turn it from where it is then.
void ObjectTurning::Turned::turn(double by_deg, SessionTime at) noexcept {
    go_to(at);
    angle_deg = from_deg = within(angle_deg + by_deg);
    since = at;
}

bool ObjectTurning::take(const ObserverInput& input) noexcept {
    using Kind = ObserverInput::Kind;
    bool is_taken = false;
    for (std::size_t i = 0; i < turned_.size(); ++i) {
        Turned& turned = turned_[i];
        if (!turned.is_lit)
            continue;
        bool has_moved = false;
        switch (input.kind) {
        case Kind::key_down:
        case Kind::key_up:
            has_moved = take_key(turned, input);
            break;
        case Kind::pointer_down:
        case Kind::pointer_moved:
        case Kind::pointer_up:
            has_moved = take_pointer(turned, input);
            break;
        case Kind::wheel:
        case Kind::dial:
            has_moved = input.kind == Kind::dial ? turned.by_keys() : turned.by_mouse();
            if (has_moved)
                turned.turn(turned.by().step.value * input.steps, input.at);
            break;
        case Kind::let_go:
            turned.turn(0.0, input.at);
            turned.is_less_held = turned.is_more_held = turned.is_dragged = false;
            break;
        case Kind::text:
            break;
        }
        if (!has_moved)
            continue;
        is_taken = true;
        turned.input_at = input.at;
        note(input, i);
    }
    return is_taken;
}

bool ObjectTurning::take_key(Turned& turned, const ObserverInput& input) noexcept {
    const std::string_view key = input.key.view();
    const bool is_less = key == turned.by().keys.front(), is_more = key == turned.by().keys.back();
    if (!turned.by_keys() || (!is_less && !is_more))
        return false;
    const bool is_down = input.kind == ObserverInput::Kind::key_down;
    bool& held = is_less ? turned.is_less_held : turned.is_more_held;
    // One that was let go without having been pressed here was held before.
    if (held == is_down)
        return is_down;
    turned.turn(0.0, input.at);
    held = is_down;
    return true;
}

bool ObjectTurning::take_pointer(Turned& turned, const ObserverInput& input) noexcept {
    if (!turned.by_mouse())
        return false;
    if (input.kind == ObserverInput::Kind::pointer_down) {
        if (input.button > 1 || !turned.is_at(input.right_px, input.down_px))
            return false;
        turned.is_dragged = true;
        turned.dragged_px = input.right_px;
        return true;
    }
    if (!turned.is_dragged)
        return false;
    turned.turn((input.right_px - turned.dragged_px) * turned.deg_per_px(), input.at);
    turned.dragged_px = input.right_px;
    turned.is_dragged = input.kind != ObserverInput::Kind::pointer_up;
    return true;
}

void ObjectTurning::go_to(SessionTime now) noexcept {
    for (Turned& turned : turned_)
        if (turned.is_lit)
            turned.go_to(now);
}

std::optional<ObjectTurning::Shown> ObjectTurning::pose_of(int place) const noexcept {
    for (const Turned& turned : turned_)
        if (turned.place == place)
            return Shown{{turned.by().nearest({turned.angle_deg})}, turned.input_at};
    return std::nullopt;
}

void ObjectTurning::note(const ObserverInput& input, std::size_t turned) noexcept {
    if (taken_.size() == taken_.capacity()) {
        ++lost_inputs_;
        return;
    }
    taken_.push_back({input, turned, turned_[turned].angle_deg});
}

void ObjectTurning::add_to(std::vector<AnswerInput>& inputs) const {
    for (const Taken& taken : taken_)
        inputs.push_back({.id = turned_[taken.turned].motion->id,
                          .item = turned_[taken.turned].slot,
                          .input = taken.input,
                          .state = InputState::open,
                          .has_counted = true,
                          .number = taken.angle_deg});
}

} // namespace overt
