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
        turned.at_deg = {motion.by_observer.angle_of(pose).value,
                         motion.by_observer.elevation_of(pose).value};
    }
    if (!turned_.empty())
        taken_.reserve(most_turning_inputs);
}

void ObjectTurning::begin_show(const std::vector<int>& places) {
    for (Turned& turned : turned_) {
        turned.is_lit = std::ranges::find(places, turned.place) != places.end();
        turned.let_go();
        turned.input_at.reset(); // it stands as it was left, by nothing that came in this show
    }
}

void ObjectTurning::end_show() noexcept {
    for (Turned& turned : turned_) {
        turned.is_lit = false;
        turned.let_go();
    }
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
        TurningOffer offer;
        offer.show = show;
        offer.place = turned.place;
        offer.since = since;
        offer.lasts_s = lasts_s;
        if (turned.by_keys()) {
            offer.less = turned.by().keys[0];
            offer.more = turned.by().keys[1];
        }
        offer.speed_deg_s = turned.by().speed_deg_s;
        offer.deg_per_px = turned.deg_per_px();
        offer.right_px = turned.left_px + 0.5 * turned.width_px;
        offer.down_px = turned.top_px + 0.5 * turned.height_px;
        offer.turn_sd_deg = turned.by().simulated_turn_deg;
        offer.pause_s = turned.by().simulated_pause_s;
        offer.drags_tilt = turned.by().has_elevations() && !turned.by_keys();
        offers.push_back(offer);
        if (!turned.by().has_elevations() || !turned.by_keys())
            continue;
        offer.is_elevation = true;
        offer.less = turned.by().keys[2];
        offer.more = turned.by().keys[3];
        offers.push_back(offer);
    }
    return offers;
}

bool ObjectTurning::Turned::is_at(double right_px, double down_px) const {
    return right_px >= left_px && right_px < left_px + width_px && down_px >= top_px &&
           down_px < top_px + height_px;
}

/// Where it can be turned all round the angle goes on, else it stays at the ends.
glm::dvec2 ObjectTurning::Turned::within(glm::dvec2 deg) const noexcept {
    const int last = by().pose_count() - 1;
    if (!by().is_whole())
        deg.x = std::clamp(deg.x, by().from.value, by().angle_of(last).value);
    deg.y = std::clamp(deg.y, by().elevation_of(0).value, by().elevation_of(last).value);
    return deg;
}

void ObjectTurning::Turned::let_go() noexcept {
    is_held.fill(false);
    is_dragged = false;
}

/// Time may go back by as much as an input came late.
void ObjectTurning::Turned::go_to(SessionTime now) noexcept {
    const glm::dvec2 way(double(is_held[1]) - double(is_held[0]), double(is_held[3]) - double(is_held[2]));
    if (way != glm::dvec2(0.0))
        at_deg = within(from_deg + way * (by().speed_deg_s * to_seconds(now - since)));
}

/// From now on held keys turn it from where it is then.
void ObjectTurning::Turned::turn(glm::dvec2 by_deg, SessionTime at) noexcept {
    go_to(at);
    at_deg = from_deg = within(at_deg + by_deg);
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
        case Kind::tilt:
            has_moved = turned.by_keys() && turned.by().has_elevations();
            if (has_moved)
                turned.turn({0.0, turned.by().elevation_step.value * input.steps}, input.at);
            break;
        case Kind::wheel:
        case Kind::dial:
            has_moved = input.kind == Kind::dial ? turned.by_keys() : turned.by_mouse();
            if (has_moved)
                // It goes round with a knob: clockwise is less.
                turned.turn(
                    {turned.by().step.value * (input.kind == Kind::dial ? -input.steps : input.steps), 0.0},
                    input.at);
            break;
        case Kind::let_go:
            turned.turn(glm::dvec2(0.0), input.at);
            turned.let_go();
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
    const std::vector<std::string>& keys = turned.by().keys;
    const auto key = static_cast<std::size_t>(std::ranges::find(keys, input.key.view()) - keys.begin());
    if (!turned.by_keys() || key >= std::min(keys.size(), turned.is_held.size()) ||
        (key > 1 && !turned.by().has_elevations()))
        return false;
    const bool is_down = input.kind == ObserverInput::Kind::key_down;
    // One that was let go without having been pressed here was held before.
    if (turned.is_held[key] == is_down)
        return is_down;
    turned.turn(glm::dvec2(0.0), input.at);
    turned.is_held[key] = is_down;
    return true;
}

bool ObjectTurning::take_pointer(Turned& turned, const ObserverInput& input) noexcept {
    if (!turned.by_mouse())
        return false;
    const glm::dvec2 at_px(input.right_px, input.down_px);
    if (input.kind == ObserverInput::Kind::pointer_down) {
        if (input.button > 1 || !turned.is_at(input.right_px, input.down_px))
            return false;
        turned.is_dragged = true;
        turned.dragged_px = at_px;
        return true;
    }
    if (!turned.is_dragged)
        return false;
    turned.turn((at_px - turned.dragged_px) * turned.deg_per_px(), input.at);
    turned.dragged_px = at_px;
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
            return Shown{{turned.by().nearest({turned.at_deg.x}, {turned.at_deg.y})}, turned.input_at};
    return std::nullopt;
}

void ObjectTurning::note(const ObserverInput& input, std::size_t turned) noexcept {
    if (taken_.size() == taken_.capacity()) {
        ++lost_inputs_;
        return;
    }
    taken_.push_back({input, turned, turned_[turned].at_deg.x});
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
