#include "experiment/session/trial_run.h"

#include <array>
#include <cmath>

#include <fmt/format.h>

#include "experiment/base/counted.h"
#include "experiment/design/match_levels.h"
#include "experiment/ports/event_kinds.h"
#include "experiment/ports/trial_mark.h"
#include "experiment/protocol/all_stimuli.h"
#include "experiment/session/session_screens.h"

namespace overt {

namespace {

constexpr SessionDuration poll_interval = std::chrono::milliseconds(4);

/// The two clocks that tell of a sleep are read one after the other: less than this may be that.
constexpr double shortest_sleep_s = 0.005;

/// A wall clock that is kept right over a network is slewed by up to 0.5 ms a second: 40 ms in a minute and a
/// half is that, more is a step.
constexpr double smallest_wall_step_s = 0.1;

} // namespace

TrialRun::TrialRun(SessionState& state, OperatorControl& control, const ScreenPoint& screen_centre,
                   const Schedule& schedule)
    : state_(state), control_(control), drift_checks_(state, control, screen_centre),
      answers_(state, control), probes_(state.protocol, state.ports),
      asking_(state, control, schedule, probes_), seed_(schedule.seed), cycles_(page_cycles(state.protocol)),
      poses_(poses_of(state.protocol)), shown_(cycles_.front()), ledger_(shown_, WhenLate::drop),
      watch_(screen_geometry_of(state.protocol), state.protocol.display) {
    for (UsedTracker& used : state.trackers())
        feeds_.push_back({used, TrackerFeed(used.tracker), {}});
}

TrialRun::Attempt TrialRun::run(const Trial& trial, const std::optional<Trial>& next, bool is_practice) {
    Attempt attempt;
    attempt.outcome.status = TrialOutcome::Status::aborted;
    control_.begin_trial();
    state_.write_down();
    state_.markers.begin_trial(trial, is_practice);
    state_.enter(SessionPhase::trial, is_practice ? -1 : trial.index);
    first_levels_.clear();
    const std::vector<PlacedStimulus> loaded = loaded_for(state_.protocol, trial, &first_levels_);
    loaded_count_ = loaded.size();
    state_.ports.presenter.load_slots(loaded);
    state_.log().trial_started(trial, state_.now());
    // Practice has numbers of its own.
    mark(MarkedEvent::trial, state_.now(),
         fmt::format("{}{}{}", trial_mark, is_practice ? "practice " : "", trial.index + 1));
    const Clock::Disturbance before = state_.ports.clock.disturbance();
    Running running{.trial = trial, .next = next, .is_practice = is_practice, .attempt = attempt};
    running.plan = plan_trial(state_.protocol, seed_, trial, is_practice);
    probes_.begin_trial(trial);
    turning_.begin_trial(state_.protocol, trial, seed_, is_practice);
    recorded_.begin_trial(state_.protocol, trial);
    asking_.begin_trial(trial, running.plan, turning_, is_practice);
    run_steps(running);
    asking_.finish(attempt.outcome);
    probes_.complete(attempt.outcome.given);
    note_disturbance(before);
    mark_result(trial, attempt);
    state_.write_down();
    const TrialDecision::Kind decision = control_.decision().kind;
    attempt.result.is_rejected = attempt.result.is_rejected || decision == TrialDecision::Kind::rejected;
    attempt.result.is_repeated = decision == TrialDecision::Kind::repeated;
    attempt.result.is_tracker_lost =
        attempt.result.is_tracker_lost || (attempt.result.is_repeated && control_.decision().is_tracker_lost);
    attempt.result.is_skipped = decision == TrialDecision::Kind::skipped;
    return attempt;
}

bool TrialRun::goes_on(const Attempt& attempt) const {
    return !state_.is_over() && !attempt.result.is_over() &&
           control_.decision().kind == TrialDecision::Kind::none;
}

/// All that may allocate before the first flip of a show.
void TrialRun::begin_show(Running& running, std::size_t number) {
    const PlannedStep& step = running.plan.steps[number];
    const Trial& trial = running.trial;
    lit_ = trial.only(step.places);
    const auto cycle_of = [&](const Stimulus& stimulus) {
        const bool is_turned = !state_.protocol.motion_of(stimulus).has_plan();
        // What the observer turns, or another did, shows one frame, whichever that is now.
        const std::optional<AnimationFrameIndex> only =
            is_turned && !step.still() ? std::optional(AnimationFrameIndex{0}) : step.still();
        return cut_to(cycles_[static_cast<std::size_t>(stimulus.motion)], step.refreshes, only);
    };
    shown_ = cycle_of(lit_.stimulus);
    for (PresentationListener* listener : state_.ports.listeners)
        listener->presentation_begins(lit_, shows_);
    std::vector<PageCycle> beside;
    for (const PlacedStimulus& further : lit_.beside)
        beside.push_back(cycle_of(further.stimulus));
    slots_.begin(trial.index, loaded_count_, step.places, std::move(beside));
    begin_steering(step);
    if (!has_shown_)
        state_.ports.presenter.take_swap_modes(); // those before are not the presentation's
    TrialOutcome& outcome = running.attempt.outcome;
    probes_.begin_show(step, static_cast<int>(outcome.steps.size()) + 1,
                       slots_.frames(shown_.entry_at(0).frame, 0), outcome.probes);
    await_end(running, number, state_.now());
    add_row(running, step);
    onset_text_ = shows_ == 0 ? "SYNCTIME" : step_text(step);
    ledger_ = RefreshLedger(shown_, state_.protocol.motion_of(lit_.stimulus).when_late);
    ledger_.begin(trial.index, static_cast<int>(running.attempt.outcome.steps.size()), first_flip_);
    marked_frame_ = no_frame;
    state_.markers.begin_presentation(onset_text_);
}

void TrialRun::begin_steering(const PlannedStep& step) {
    steered_.clear();
    const std::vector<int> moving = step.still() ? std::vector<int>() : step.places;
    turning_.begin_show(moving);
    recorded_.begin_show(moving);
    const Task& task = state_.protocol.tasks[static_cast<std::size_t>(lit_.task)];
    for (std::size_t i = 0; i < step.places.size(); ++i) {
        const int place = step.places[i];
        Steered steered{.lit = i, .first_level = 0, .next = {.trial = lit_.index, .place = place}};
        std::size_t match = 0;
        for (const TaskAnswer& answer : task.answers) {
            if (!is_match(answer))
                continue;
            if (slots_named(state_.protocol, {answer.slot}) == std::vector{lit_.shown(i).slot})
                steered.first_level = first_levels_[match];
            ++match;
        }
        const bool is_set = steered.first_level > 0 && asking_.level_of(place);
        const bool is_turned =
            !step.still() && state_.protocol.motion_of(lit_.shown(i).stimulus).kind == MotionKind::observer;
        if (is_set || is_turned)
            steered_.push_back(steered);
    }
}

/// Has what is lit as the i-th show a frame at the next flip, whatever the cycle says.
void TrialRun::turn_to(std::size_t lit, AnimationFrameIndex frame) noexcept {
    const PageCycleEntry entry{frame, poses_.pose_of(lit_.shown(lit).stimulus.motion, frame), 1};
    if (lit == 0)
        shown_.entries.front() = entry;
    else
        slots_.turn_to(lit, entry);
}

/// Before a flip: what of it the observer has moved by now, or moved in the session that is shown again.
void TrialRun::steer(const std::vector<int>& places) noexcept {
    for (std::size_t i = 0; i < places.size(); ++i)
        if (const auto frame = recorded_.frame_of(places[i], ledger_.next_refresh()))
            turn_to(i, *frame);
    if (steered_.empty())
        return;
    turning_.go_to(state_.now());
    for (Steered& steered : steered_) {
        SteeredFlip& next = steered.next;
        next.input_at.reset();
        if (const auto set = asking_.level_of(next.place); set && steered.first_level > 0) {
            next.level = set->level;
            next.input_at = set->input_at;
            slots_.show_as(steered.lit, steered.first_level + static_cast<std::size_t>(set->level));
        }
        const std::optional<ObjectTurning::Shown> pose = turning_.pose_of(next.place);
        if (!pose || !turning_.is_active())
            continue;
        if (pose->input_at && (!next.input_at || *pose->input_at > *next.input_at))
            next.input_at = pose->input_at;
        turn_to(steered.lit, pose->frame);
    }
}

void TrialRun::note_steered(const FlipRecord& flip) noexcept {
    for (Steered& steered : steered_) {
        steered.next.refresh_in_trial = flip.refresh_in_trial;
        state_.log().steered_flip(steered.next);
    }
}

/// Records what was shown at each refresh up to this flip, and tells those who follow it.
void TrialRun::note_flip(const FlipRecord& flip) noexcept {
    SessionLog& log = state_.log();
    const int refresh = ledger_.last_refresh();
    for (int i = 0; i < ledger_.missed_count(); ++i)
        log.missed(slots_.of_first(ledger_.missed(i)));
    log.flip(slots_.of_first(flip));
    const std::span<const SlotFlip> rows = slots_.enter(flip, refresh);
    for (const SlotFlip& of_slot : rows)
        log.slot_flip(of_slot);
    note_steered(flip);
    mark_flip(flip);
    state_.markers.flipped(flip, refresh);
    watch_.flipped(flip, rows);
    // To them the lead is the first of what is lit.
    const std::span<const SlotFlip> beside = rows.last(lit_.beside.size());
    for (PresentationListener* const listener : state_.ports.listeners) {
        listener->flipped(flip);
        for (std::size_t i = 0; i < beside.size(); ++i) {
            SlotFlip of_lit = beside[i];
            of_lit.place = static_cast<int>(i) + 1;
            listener->slot_flipped(of_lit);
        }
    }
}

/// What came of a show, after its last flip.
void TrialRun::note_show(Running& running, std::size_t number) {
    const PlannedStep& step = running.plan.steps[number];
    TrialOutcome& outcome = running.attempt.outcome;
    has_shown_ = true;
    turning_.end_show();
    if (ledger_.shown_refreshes() > 0) {
        if (shows_++ == 0)
            outcome.presentation_onset = ledger_.onset();
        first_flip_ = ledger_.first();
        begin_row(running, ledger_.onset());
    }
    outcome.shown_refreshes += ledger_.shown_refreshes();
    outcome.missed_refreshes += ledger_.missed_refreshes();
    running.attempt.result.missed_refreshes = outcome.missed_refreshes;
    AttemptStep& row = outcome.steps.back();
    row.ended_by = ledger_.is_complete()       ? StepEnd::time
                   : watch_.has_come()         ? StepEnd::gaze
                   : was_next_pressed_         ? StepEnd::key
                   : is_cut_short()            ? StepEnd::stopped
                   : asking_.has_ended(number) ? StepEnd::answer
                                               : StepEnd::patience;
    take_gaze(row, step);
}

/// Lights the step's stimuli for its refreshes, or until something else ends it.
void TrialRun::present(Running& running, std::size_t number) {
    const Trial& trial = running.trial;
    const PlannedStep& step = running.plan.steps[number];
    Presenter& presenter = state_.ports.presenter;
    TrackerFeed& own = feeds_.front().items;
    begin_show(running, number);
    const int patience = step.patience_refreshes.value_or(shown_.total_refreshes);

    // From here to the last flip nothing allocates, opens, throws or formats.
    while (!ledger_.is_complete() && ledger_.next_refresh() < patience && !is_cut_short() &&
           !watch_.has_come() && !was_next_pressed_ && !asking_.has_ended(number)) {
        // Take what the trackers have seen so far.
        take_items(trial.index);
        if (watch_.has_come())
            break;
        // Show the frame that the plan has next, or that the observer moved to, and learn when it was lit.
        steer(step.places);
        state_.markers.before_flip(ledger_.next_refresh(), ledger_.next().frame, presenter);
        const std::span<const AnimationFrameIndex> frames =
            slots_.frames(ledger_.next().frame, ledger_.next_refresh());
        probes_.before_flip(frames, asking_.gauge(number), running.attempt.outcome.probes);
        note_flip(ledger_.enter(presenter.flip_slots(frames)));
        // Take what the observer answers, and remember what the operator pressed, here or at the tracker's
        // host.
        if (ledger_.shown_refreshes() == 1)
            asking_.stimulus_lit(number, ledger_.onset());
        look_at_keys();
        own.look_at_state();
    }
    note_show(running, number);
}

/// Of all trackers; that of the session must begin, the others may be missing.
void TrialRun::start_recording() {
    pressed_.reset();
    // The session's own is asked first: without it there is no presentation.
    for (Feed& feed : feeds_)
        if (!feed.used.is_left_out && !feed.items.start_recording(state_.now()) && !feed.used.is_further())
            return;
}

/// What became of the trackers' clocks and samples meanwhile. An attempt in which the clock of the session's
/// own jumped has samples whose times are not known.
void TrialRun::note_what_came(Attempt& attempt) {
    for (Feed& feed : feeds_) {
        if (feed.used.is_left_out)
            continue;
        if (feed.used.tracker.measures_gaze()) {
            GazeYield gaze = feed.items.yield();
            gaze.samples += feed.earlier.samples;
            gaze.without_gaze += feed.earlier.without_gaze;
            gaze.missing += feed.earlier.missing;
            if (has_shown_)
                feed.earlier = gaze;
            state_.log_of(feed.used).gaze_came(gaze);
            if (!feed.used.is_further()) {
                attempt.outcome.gaze = gaze;
                attempt.result.gaze_lost_share = 1.0 - gaze.share();
            }
        }
        const std::int64_t doubled = feed.items.doubled_count();
        if (doubled > 0)
            state_.note_of(feed.used, tracker_event,
                           fmt::format("{} came twice and {} left out the second time",
                                       counted(doubled, "sample"), doubled == 1 ? "was" : "were"));
        if (const std::optional<SessionDuration> jump = feed.items.take_jump()) {
            state_.note_of(feed.used, tracker_clock_jumped_event,
                           fmt::format("by {:+.3f} ms in the trial", 1e3 * to_seconds(*jump)));
            attempt.result.has_clock_jumped = attempt.result.has_clock_jumped || !feed.used.is_further();
        }
    }
}

/// Further trackers that did not record all of the presentation. The operator is asked about them before the
/// next trial: this one goes on.
void TrialRun::note_lost_trackers() {
    for (Feed& feed : feeds_)
        if (feed.used.is_further() && !feed.used.is_left_out && feed.items.state() == RecordingState::lost) {
            feed.used.is_lost = true;
            feed.used.why_lost = feed.items.why_lost();
            state_.note_of(feed.used, tracker_lost_event, feed.used.why_lost);
        }
}

void TrialRun::mark(MarkedEvent event, SessionTime at, std::string_view text) noexcept {
    mark_trackers(at, text);
    state_.markers.mark(event, at, text);
}

void TrialRun::mark_trackers(SessionTime at, std::string_view text) noexcept {
    for (Feed& feed : feeds_)
        if (!feed.used.is_left_out)
            feed.used.tracker.mark({at, text});
}

/// For the trackers, the onset of a show, and each change of the frame of the first that it lights: "FRAME
/// 12" is on the screen from its flip's vertical blank on.
void TrialRun::mark_flip(const FlipRecord& flip) noexcept {
    if (flip.shown == marked_frame_)
        return;
    const SessionTime lit = flip.report.vertical_blank;
    if (marked_frame_ == no_frame)
        mark_trackers(lit, onset_text_);
    marked_frame_ = flip.shown;
    std::array<char, 24> text{};
    const auto end = fmt::format_to_n(text.data(), text.size(), "FRAME {}", flip.shown.value).out;
    mark_trackers(lit, {text.data(), end});
}

/// What a viewer of the tracker's file groups trials by, and how the attempt ended.
void TrialRun::mark_result(const Trial& trial, const Attempt& attempt) {
    const SessionTime now = state_.now();
    const auto variable = [&](std::string_view name, std::string_view value) {
        const std::string text = fmt::format("!V TRIAL_VAR {} {}", name, value);
        mark_trackers(now, text);
        state_.markers.tell(now, text);
    };
    variable("task", state_.protocol.tasks[static_cast<std::size_t>(trial.task)].id);
    variable("object", state_.protocol.objects[static_cast<std::size_t>(trial.stimulus.object)].id);
    variable("material", state_.protocol.materials[static_cast<std::size_t>(trial.stimulus.material)].id);
    for (const auto& [stimulus, slot] : trial.beside) {
        const std::string in = state_.protocol.slots[static_cast<std::size_t>(slot)].id + ".";
        variable(in + "object", state_.protocol.objects[static_cast<std::size_t>(stimulus.object)].id);
        variable(in + "material", state_.protocol.materials[static_cast<std::size_t>(stimulus.material)].id);
    }
    for (const auto& [name, value] : answer_variables(attempt.outcome.given))
        variable(name, value);
    variable("missed_refreshes", state_.ports.has_proven_times
                                     ? fmt::format("{}", attempt.outcome.missed_refreshes)
                                     : std::string("unproven"));
    mark(MarkedEvent::result, now, fmt::format("TRIAL_RESULT {}", goes_on(attempt) ? 0 : 1));
}

void TrialRun::look_at_keys() noexcept {
    while (const std::optional<ResponsePress> press = state_.ports.panel.poll()) {
        const bool ends_it = press->key == ResponsePress::Key::abort;
        if (press->key == ResponsePress::Key::next)
            was_next_pressed_ = awaits_key_;
        // The key that ends the session replaces one that was pressed before.
        if (is_operators(press->key) && (!pressed_ || ends_it))
            pressed_ = press;
    }
    asking_.look();
}

/// What was decided at the tracker's host, or became of the tracker, becomes of the attempt.
void TrialRun::act_on_tracker(Attempt& attempt) {
    const TrackerFeed& own = feeds_.front().items;
    if (own.state() == RecordingState::running || state_.is_over())
        return;
    if (own.has_recorded() && !has_ended_in_order_)
        state_.note(presentation_broken_off_event,
                    fmt::format("by the eye tracker, after {}",
                                counted(attempt.outcome.shown_refreshes, "refresh", "refreshes")));
    switch (own.state()) {
    case RecordingState::running:
        break;
    case RecordingState::repeat:
        state_.note(operator_event, "repeats the trial, at the eye tracker");
        control_.repeat_trial();
        break;
    case RecordingState::skip:
        state_.note(operator_event, "skips the trial, at the eye tracker");
        control_.skip_trial("skipped at the eye tracker");
        break;
    case RecordingState::abort:
        state_.note(operator_event, "ends the session, at the eye tracker");
        state_.end_session("aborted at the eye tracker");
        break;
    case RecordingState::lost:
        attempt.result.is_tracker_lost = true;
        control_.regain_tracker(own.why_lost());
        break;
    }
}

void TrialRun::act_on_pressed_keys(Attempt& attempt) {
    if (!pressed_ || state_.is_over())
        return;
    const bool was_broken_off = !has_ended_in_order_;
    if (was_broken_off)
        state_.log().event({pressed_->pressed_at, state_.trial(), presentation_broken_off_event,
                            fmt::format("by a key, after {}",
                                        counted(attempt.outcome.shown_refreshes, "refresh", "refreshes"))});
    control_.act_on(*pressed_);
    // The observer saw only a part of the animation: this attempt does not count, whatever was answered.
    attempt.result.is_broken_off = attempt.result.is_broken_off || was_broken_off;
}

/// While a machine sleeps its screen shows nothing, whatever the ledger says. A wall clock that was set
/// leaves session time as it was, but shifts the times that other programs recorded.
void TrialRun::note_disturbance(const Clock::Disturbance& before) {
    const Clock::Disturbance now = state_.ports.clock.disturbance();
    const double slept_s = to_seconds(now.slept - before.slept);
    const double moved_s = to_seconds(now.wall_moved - before.wall_moved);
    if (slept_s > shortest_sleep_s)
        state_.note(machine_slept_event,
                    fmt::format("{:.3f} s, in which nothing was shown or recorded", slept_s));
    if (std::abs(moved_s) > smallest_wall_step_s)
        state_.note(wall_clock_set_event,
                    fmt::format("by {:+.3f} s; session time went on as before", moved_s));
}

void TrialRun::take_items(int trial) noexcept {
    for (Feed& feed : feeds_)
        if (!feed.used.is_left_out && feed.items.has_recorded())
            feed.items.take_items(trial, state_.log_of(feed.used),
                                  feed.used.is_further() ? nullptr : &watch_);
}

void TrialRun::wait_and_take_items(int trial, SessionTime until) noexcept {
    while (state_.now() < until) {
        take_items(trial);
        state_.ports.clock.wait_until(std::min(until, state_.now() + poll_interval));
    }
    take_items(trial);
}

void TrialRun::read_clocks() noexcept {
    for (Feed& feed : feeds_)
        if (!feed.used.is_left_out)
            feed.items.read_clocks(state_.log_of(feed.used));
}

} // namespace overt
