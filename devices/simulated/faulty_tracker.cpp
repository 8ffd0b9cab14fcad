#include "devices/simulated/faulty_tracker.h"

#include <algorithm>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/ports/trial_mark.h"

namespace overt {

namespace {

using FaultKind = TrackerFault::Kind;

constexpr std::string_view unplugged = "the simulated eye tracker is unplugged";

double seconds_between(TrackerTime from, TrackerTime to) {
    return 1e-6 * static_cast<double>((to - from).count());
}

std::string sentence_on(const TrackerFault& fault) {
    switch (fault.kind) {
    case FaultKind::clock_jump:
        return fmt::format("clock-jump by {:+g} ms at {:g} s", fault.ms, fault.at_s);
    case FaultKind::slow_start:
        return fmt::format("slow-start by {:g} s", fault.s);
    case FaultKind::unplug:
    case FaultKind::repeat:
    case FaultKind::skip:
    case FaultKind::abort:
        return fmt::format("{} at {:g} s", name_of(fault.kind), fault.at_s);
    case FaultKind::calibration:
        return fmt::format("calibration {} failed", fault.number);
    default:
        return fmt::format("{} for {:g} s at {:g} s", name_of(fault.kind), fault.s, fault.at_s);
    }
}

} // namespace

FaultyTracker::FaultyTracker(std::unique_ptr<EyeTracker> tracker, Clock& clock, TrackerFaults faults)
    : tracker_(std::move(tracker)), clock_(&clock), faults_(std::move(faults)), read_(1024) {
    // Nothing is allocated while it records.
    now_.reserve(faults_.given.size());
    ahead_.reserve(4);
}

void FaultyTracker::require_connection() const {
    if (state_ == RecordingState::lost)
        throw DeviceError(std::string(unplugged));
}

SetupOutcome FaultyTracker::set_up(SetupScreen& setup_screen) {
    require_connection();
    ++set_ups_;
    for (const TrackerFault& fault : faults_.given)
        if (fault.kind == FaultKind::calibration && fault.number == set_ups_) {
            struck_.push_back(sentence_on(fault));
            return {SetupOutcome::Kind::failed, {}, {}, "the simulated eye tracker found no eye"};
        }
    return tracker_->set_up(setup_screen);
}

DriftOutcome FaultyTracker::drift_check(ScreenPoint target) {
    require_connection();
    return tracker_->drift_check(target);
}

std::optional<ClockPair> FaultyTracker::read_clocks() noexcept {
    if (state_ == RecordingState::lost)
        return std::nullopt;
    std::optional<ClockPair> pair = tracker_->read_clocks();
    if (pair)
        pair->other += put_forward_;
    return pair;
}

/// Trials are counted from 1 in marks. Practice has no number.
void FaultyTracker::mark(const TrackerMark& mark) noexcept {
    tracker_->mark(mark);
    if (!begins_trial(mark.text))
        return;
    trial_ = trial_of_mark(mark.text).value_or(-1);
    if (trial_ >= 0)
        ++attempts_[trial_]; // between presentations, where it may allocate
}

void FaultyTracker::start_recording() {
    require_connection();
    now_.clear();
    for (const TrackerFault& fault : faults_.given)
        if (fault.kind != FaultKind::calibration && fault.trial.value_or(trial_) == trial_ &&
            fault.attempt == attempts_[trial_]) // 0 in practice
            now_.push_back({fault});
    first_.reset();
    lost_ = 0;
    next_ = end_ = 0;
    ahead_.clear();
    state_ = RecordingState::running;
    for (const Striking& striking : now_)
        if (striking.fault.kind == FaultKind::unplug && striking.fault.at_s <= 0.0) {
            struck_.push_back(sentence_on(striking.fault));
            refusals_ = striking.fault.refusals;
            state_ = RecordingState::lost;
            require_connection();
        }
    tracker_->start_recording();
    recording_ = true;
}

void FaultyTracker::stop_recording() {
    if (!recording_)
        return;
    tracker_->stop_recording();
    recording_ = false;
    for (const Striking& striking : now_)
        if (striking.has_struck)
            struck_.push_back(sentence_on(striking.fault));
    // The recording's last samples are still to come, and the faults strike them too.
    if (state_ != RecordingState::lost)
        stalled_until_.reset(); // what was held back comes now
}

bool FaultyTracker::is_within(const Striking& striking, double elapsed_s) const noexcept {
    const double begin = striking.fault.at_s;
    return elapsed_s >= begin && elapsed_s < begin + striking.fault.s;
}

void FaultyTracker::look_at_stall() noexcept {
    if (!stalled_until_)
        return;
    const SessionTime now = clock_->now();
    if (now >= *stalled_until_)
        stalled_until_.reset();
    else if (now - *stalled_since_ > patience)
        state_ = RecordingState::lost;
}

std::size_t FaultyTracker::poll(std::span<TrackerItem> into) noexcept {
    std::size_t taken = 0;
    while (taken < into.size()) {
        if (!ahead_.empty()) {
            into[taken++] = ahead_.back();
            ahead_.pop_back();
            continue;
        }
        look_at_stall();
        if (state_ == RecordingState::lost || stalled_until_)
            break;
        if (next_ == end_) {
            next_ = 0;
            end_ = tracker_->poll(read_);
            if (end_ == 0) {
                if (recording_ || lost_ == 0)
                    break;
                ahead_.emplace_back(TrackerGap{lost_by_, last_, lost_});
                lost_ = 0;
                continue;
            }
        }
        if (pass(read_[next_]))
            ++next_;
    }
    return taken;
}

/// False: it is held back and comes again.
bool FaultyTracker::pass(TrackerItem& item) noexcept {
    if (auto* sample = std::get_if<GazeSample>(&item))
        return pass_sample(*sample);
    if (const bool is_withheld = lost_ > 0; !is_withheld) {
        put_forward(item, put_forward_);
        ahead_.push_back(item);
    }
    return true;
}

bool FaultyTracker::pass_sample(GazeSample& sample) noexcept {
    if (!first_)
        first_ = sample.sampled_at;
    const double elapsed_s = seconds_between(*first_, sample.sampled_at);
    bool is_withheld = false, is_late = false, is_doubled = false;
    for (Striking& striking : now_) {
        const TrackerFault& fault = striking.fault;
        bool strikes = is_within(striking, elapsed_s);
        switch (fault.kind) {
        case FaultKind::slow_start:
            strikes = elapsed_s < fault.s;
            is_late |= strikes;
            break;
        case FaultKind::gap:
        case FaultKind::garbage:
            is_withheld |= strikes;
            if (strikes)
                lost_by_ = fault.kind == FaultKind::gap ? TrackerGap::Reason::connection
                                                        : TrackerGap::Reason::unreadable;
            break;
        case FaultKind::doubled:
            is_doubled |= strikes;
            break;
        case FaultKind::no_eye:
            if (strikes) {
                sample.gaze.reset();
                sample.pupil_area = 0.0F;
            }
            break;
        case FaultKind::stall:
            if (strikes && !striking.has_struck) {
                striking.has_struck = true;
                stalled_since_ = clock_->now();
                stalled_until_ = *stalled_since_ + from_seconds(fault.s);
                return false;
            }
            break;
        case FaultKind::clock_jump:
            strikes = elapsed_s >= fault.at_s;
            if (strikes && !striking.has_struck)
                put_forward_ += TrackerClock::duration(static_cast<std::int64_t>(1e3 * fault.ms));
            break;
        case FaultKind::unplug:
        case FaultKind::repeat:
        case FaultKind::skip:
        case FaultKind::abort:
            strikes = elapsed_s >= fault.at_s;
            if (strikes && !striking.has_struck) {
                state_ = fault.kind == FaultKind::unplug   ? RecordingState::lost
                         : fault.kind == FaultKind::repeat ? RecordingState::repeat
                         : fault.kind == FaultKind::skip   ? RecordingState::skip
                                                           : RecordingState::abort;
                if (state_ == RecordingState::lost) {
                    refusals_ = fault.refusals;
                    striking.has_struck = true;
                    return true;
                }
            }
            break;
        case FaultKind::calibration:
            break;
        }
        striking.has_struck |= strikes;
    }
    if (is_late)
        return true;
    if (is_withheld) {
        ++lost_;
        return true;
    }
    sample.sampled_at += put_forward_;
    if (is_doubled)
        ahead_.emplace_back(sample);
    ahead_.emplace_back(sample);
    if (lost_ > 0)
        ahead_.emplace_back(TrackerGap{lost_by_, last_, lost_});
    lost_ = 0;
    last_ = sample.sampled_at;
    return true;
}

void FaultyTracker::reconnect() {
    if (refusals_ > 0) {
        --refusals_;
        throw DeviceError(std::string(unplugged));
    }
    tracker_->stop_recording();
    tracker_->reconnect();
    // What was on its way when it was lost does not come any more.
    while (tracker_->poll(read_) == read_.size()) {
    }
    next_ = end_ = 0;
    ahead_.clear();
    lost_ = 0;
    stalled_until_.reset();
    state_ = RecordingState::running;
}

std::vector<std::string> FaultyTracker::take_struck() { return std::exchange(struck_, {}); }

} // namespace overt
