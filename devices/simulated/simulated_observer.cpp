#include "devices/simulated/simulated_observer.h"

#include <algorithm>

#include "experiment/base/error.h"
#include "experiment/events/main_sequence.h"

namespace overt {

namespace {

constexpr SessionDuration latency_to_target = std::chrono::milliseconds(200);
constexpr SessionDuration lingering = std::chrono::milliseconds(150);
constexpr SessionDuration rest_after_saccade = std::chrono::milliseconds(20);

ScreenPoint between(ScreenPoint from, ScreenPoint to, double share) {
    return {from.x_px + share * (to.x_px - from.x_px), from.y_px + share * (to.y_px - from.y_px)};
}

/// Of a slot among so many that are lit; of one alone it makes no difference.
double weight_of(int slot, const GazeFavour& favour, std::size_t count) {
    if (favour.slot < 0)
        return 1.0;
    return slot == favour.slot ? favour.share : (1.0 - favour.share) / static_cast<double>(count - 1);
}

double share_of(SessionTime time, SessionTime begin, SessionTime end) {
    return to_seconds(time - begin) / to_seconds(end - begin);
}

} // namespace

SimulatedObserver::Presentation::Presentation(const ObservedScene& scene, const ObserverSettings& settings)
    : script(scene, settings) {
    // One for each refresh; a missed refresh takes its place in the count.
    shown.reserve(std::max<std::size_t>(1, scene.slots.size()));
    turned.resize(shown.capacity());
    flips.reserve(static_cast<std::size_t>(scene.longest_s() * scene.refresh_hz) + 64);
    beside.reserve(flips.capacity() * (shown.capacity() - 1));
}

SimulatedObserver::SimulatedObserver(ObservedScene scene, std::uint64_t seed,
                                     const ObserverSettings& settings)
    : scene_(std::move(scene)), seed_(seed), settings_(settings),
      wandering_(seed, settings.drift, settings.tremor), blinks_(seed, settings.blinks_per_minute),
      px_per_deg_(px_per_deg_at_centre(scene_.screen)) {
    for (std::size_t i = 0; i < scene_.animations.size(); ++i) {
        Motion& motion = motions_.emplace_back(Motion{PursuedTurn(scene_, static_cast<int>(i)), {}});
        for (int frame = 0; frame < scene_.animations[i].frame_count; ++frame)
            motion.angle_of_frame.push_back(scene_.animations[i].object_in({frame}));
    }
    for (const ObservedObject& object : scene_.objects) {
        const bool has_surface = object.mesh && !object.mesh->triangles.empty();
        targets_.push_back(has_surface ? std::make_unique<GazeTargets>(object, scene_) : nullptr);
    }
    prepare_next();
}

void SimulatedObserver::prepare_next() {
    if (begun_ == presentations_.size())
        presentations_.push_back(std::make_unique<Presentation>(scene_, settings_));
}

void SimulatedObserver::presentation_begins(const Trial& trial, int show) noexcept {
    prepare_next(); // a show may follow another directly
    Presentation& presentation = *presentations_[begun_++];
    presentation.trial = trial.index;
    presentation.shown.clear();
    const GazeFavour favour = favour_ ? favour_(trial) : GazeFavour{};
    const std::size_t count = trial.shown_count();
    for (std::size_t i = 0; i < count; ++i) {
        const auto [stimulus, slot] = trial.shown(i);
        GazePlan plan = gaze_plan(scene_, seed_, trial.task, stimulus);
        favour_area(plan, favour);
        const Motion& motion = motions_[static_cast<std::size_t>(stimulus.motion)];
        const bool is_turned = !scene_.animation_of(stimulus.motion).has_plan();
        FlippedTurn* const seen =
            is_turned && i < presentation.turned.size() ? &presentation.turned[i] : nullptr;
        if (seen) {
            seen->of = &presentation;
            seen->shown = i;
            seen->angle_of_frame = &motion.angle_of_frame;
        }
        presentation.shown.push_back({targets_[scene_.index_of({stimulus, slot})].get(),
                                      scene_.screen_of_slot(slot), plan, &motion.turn, seen, slot,
                                      weight_of(slot, favour, count)});
    }
    presentation.script.compose(scene_, presentation.shown, settings_, seed_,
                                script_number(trial.index, show));
}

void SimulatedObserver::flipped(const FlipRecord& flip) noexcept {
    OVERT_EXPECTS(begun_ > 0);
    std::vector<SeenFlip>& flips = presentations_[begun_ - 1]->flips;
    if (flips.size() < flips.capacity())
        flips.push_back({flip.report.vertical_blank, flip.shown});
}

void SimulatedObserver::slot_flipped(const SlotFlip& flip) noexcept {
    OVERT_EXPECTS(begun_ > 0);
    Presentation& presentation = *presentations_[begun_ - 1];
    const std::size_t expected = (presentation.flips.size() - 1) * (presentation.shown.size() - 1);
    // Flips that there was no room for have none of their own.
    if (presentation.beside.size() - expected < presentation.shown.size() - 1)
        presentation.beside.push_back(flip.shown);
}

/// Before the first flip, and where there was no room for more, as it stands in the motion.
ObjectPose SimulatedObserver::FlippedTurn::angle_at(SessionDuration since_lit) const noexcept {
    const ObservedPresentation& on = of->shown[shown];
    if (of->flips.empty())
        return on.turn->angle_at(since_lit);
    const SessionTime blank = std::max(of->onset() + since_lit, of->onset());
    const AnimationFrameIndex frame = of->frame_of(shown, of->flip_at(blank));
    return frame == no_frame ? on.turn->angle_at(since_lit)
                             : (*angle_of_frame)[static_cast<std::size_t>(frame.value)];
}

AnimationFrameIndex SimulatedObserver::Presentation::frame_of(std::size_t of_shown, std::size_t flip) const {
    if (of_shown == 0)
        return flips[flip].frame;
    const std::size_t index = flip * (shown.size() - 1) + of_shown - 1;
    return index < beside.size() ? beside[index] : no_frame;
}

void SimulatedObserver::screen_shown(const Screen& screen, SessionTime onset) noexcept {
    look_at(screen.kind == Screen::Kind::target ? screen.target_place.value_or(scene_.screen.centre())
                                                : scene_.screen.centre(),
            onset);
    if (begun_ > 0) {
        Presentation& presentation = *presentations_[begun_ - 1];
        if (!presentation.end) {
            presentation.end = onset;
            if (!presentation.flips.empty())
                plan_return(presentation);
        }
    }
    prepare_next();
}

void SimulatedObserver::plan_return(Presentation& presentation) const noexcept {
    const std::vector<ScriptedFixation>& fixations = presentation.script.fixations();
    SessionDuration leaves = *presentation.end + lingering - presentation.onset();
    const std::size_t current = presentation.script.fixation_at(leaves);
    if (leaves >= fixations[current].end && current + 1 < fixations.size())
        leaves = fixations[current + 1].begin + rest_after_saccade; // a saccade under way arrives first
    presentation.left_place = scripted(presentation, leaves).place;
    presentation.leaves = presentation.onset() + leaves;
    presentation.back =
        presentation.leaves +
        saccade_duration(scene_.screen.angle_between(presentation.left_place, scene_.screen.centre()));
}

void SimulatedObserver::look_at(ScreenPoint place, SessionTime onset) {
    const ScreenPoint now = places_.empty() ? scene_.screen.centre() : places_.back().to;
    if (place == now)
        return; // the same target, perhaps in another size
    places_.push_back({onset + latency_to_target, now, place});
}

SimulatedObserver::Looking SimulatedObserver::resting(SessionTime time) const noexcept {
    const auto after = std::ranges::upper_bound(places_, time, {}, &Place::since);
    if (after == places_.begin())
        return {.place = places_.empty() ? scene_.screen.centre() : places_.front().from};
    const Place& place = *std::prev(after);
    const SessionTime arrives =
        place.since + saccade_duration(scene_.screen.angle_between(place.from, place.to));
    if (time >= arrives)
        return {.place = place.to};
    return {between(place.from, place.to, saccade_progress(share_of(time, place.since, arrives))),
            EyeState::saccade, nullptr};
}

const SimulatedObserver::Presentation* SimulatedObserver::presentation_at(SessionTime time) const noexcept {
    for (std::size_t i = begun_; i-- > 0;) {
        const Presentation& presentation = *presentations_[i];
        if (presentation.flips.empty() || time < presentation.onset())
            continue;
        return presentation.end && time >= presentation.back ? nullptr : &presentation;
    }
    return nullptr;
}

SimulatedObserver::Looking SimulatedObserver::scripted(const Presentation& presentation,
                                                       SessionDuration since_onset) const noexcept {
    const std::vector<ScriptedFixation>& fixations = presentation.script.fixations();
    const std::size_t index = presentation.script.fixation_at(since_onset);
    const ScriptedFixation& fixation = fixations[index];
    const ScreenPoint place = place_of(fixation, since_onset, presentation.shown);
    const double apart = other_eye_right_px(fixation, since_onset, presentation.shown);
    if (since_onset < fixation.end || index + 1 == fixations.size())
        return {place, EyeState::fixation, &fixation, apart};
    // Both ends of the way go on with the turning object.
    const ScriptedFixation& next = fixations[index + 1];
    const double share = to_seconds(since_onset - fixation.end) / to_seconds(next.begin - fixation.end);
    const ScreenPoint to = place_of(next, since_onset, presentation.shown);
    const double progress = saccade_progress(share);
    return {between(place, to, progress), EyeState::saccade, nullptr,
            std::lerp(apart, other_eye_right_px(next, since_onset, presentation.shown), progress)};
}

SimulatedObserver::Looking SimulatedObserver::looking_at(const Presentation& presentation,
                                                         SessionTime time) const noexcept {
    if (!presentation.end || time < presentation.leaves)
        return scripted(presentation, time - presentation.onset());
    const double share = share_of(time, presentation.leaves, presentation.back);
    return {between(presentation.left_place, scene_.screen.centre(), saccade_progress(share)),
            EyeState::saccade, nullptr};
}

TrueGaze SimulatedObserver::gaze_at(SessionTime time) const noexcept {
    const Presentation* presentation = presentation_at(time);
    const Looking looking = presentation ? looking_at(*presentation, time) : resting(time);
    const glm::dvec2 away_px = wandering_.displacement_deg(time) * px_per_deg_;
    return {{looking.place.x_px + away_px.x, looking.place.y_px + away_px.y},
            blinks_.eye_closed_at(time) ? EyeState::blink : looking.state,
            looking.other_eye_right_px};
}

GazeTruth SimulatedObserver::truth_at(SessionTime time) const noexcept {
    GazeTruth truth;
    truth.gaze = gaze_at(time);
    if (const Presentation* const looked_at = presentation_at(time))
        if (const Looking looking = looking_at(*looked_at, time);
            looking.fixation && truth.gaze.state == EyeState::fixation)
            truth.target = looking.fixation->target;
    // What was lit before stays so until the light of what follows comes to the row.
    const SessionTime blank = time - scene_.light_delay(truth.gaze.place.y_px);
    const Presentation* const lit = lit_by(blank);
    if (!lit)
        return truth;
    const std::size_t flip = lit->flip_at(blank);
    truth.frame = lit->frame_of(0, flip);
    if (truth.gaze.state == EyeState::blink)
        return truth;
    for (std::size_t i = 0; i < lit->shown.size(); ++i) {
        const ObservedPresentation& of = lit->shown[i];
        const glm::dvec2 image = of.screen.image_from_screen(truth.gaze.place);
        if (!of.screen.is_inside_image(image))
            continue;
        truth.shown = i;
        truth.slot = of.slot;
        truth.frame = lit->frame_of(i, flip);
        const std::vector<ObjectPose>& angles =
            motions_[static_cast<std::size_t>(of.turn->motion())].angle_of_frame;
        if (of.targets && *truth.frame != no_frame)
            truth.surface =
                of.targets->surface_at(image, angles[static_cast<std::size_t>(truth.frame->value)]);
    }
    return truth;
}

const SimulatedObserver::Presentation* SimulatedObserver::lit_by(SessionTime blank) const noexcept {
    for (std::size_t i = begun_; i-- > 0;) {
        const Presentation& presentation = *presentations_[i];
        if (presentation.flips.empty() || blank < presentation.onset())
            continue;
        return presentation.end && blank >= *presentation.end ? nullptr : &presentation;
    }
    return nullptr;
}

std::size_t SimulatedObserver::Presentation::flip_at(SessionTime blank) const {
    const auto after = std::ranges::upper_bound(flips, blank, {}, &SeenFlip::vertical_blank);
    return static_cast<std::size_t>(std::prev(after) - flips.begin());
}

const GazeScript* SimulatedObserver::script_of(int trial) const {
    for (std::size_t i = 0; i < begun_; ++i) {
        if (presentations_[i]->trial == trial)
            return &presentations_[i]->script;
    }
    return nullptr;
}

} // namespace overt
