#include "experiment/events/event_detector.h"

#include <algorithm>

namespace overt {

void EyeMovementDetector::Stretch::add(const TrackedGaze& gaze, double speed_deg_s) {
    if (samples++ == 0)
        first_at = gaze.at;
    last_at = gaze.at;
    lasts = gaze.lasts;
    if (!gaze.gaze)
        return;
    if (valid++ == 0)
        first = gaze.gaze;
    last = gaze.gaze;
    sum_px += glm::dvec2(gaze.gaze->x_px, gaze.gaze->y_px);
    sum_pupil += static_cast<double>(gaze.pupil);
    peak_deg_s = std::max(peak_deg_s, speed_deg_s);
}

void EyeMovementDetector::Stretch::add(const Stretch& later) {
    if (later.samples == 0)
        return;
    if (samples == 0)
        first_at = later.first_at;
    last_at = later.last_at;
    lasts = later.lasts;
    if (valid == 0)
        first = later.first;
    if (later.valid > 0)
        last = later.last;
    samples += later.samples;
    valid += later.valid;
    sum_px += later.sum_px;
    sum_pupil += later.sum_pupil;
    peak_deg_s = std::max(peak_deg_s, later.peak_deg_s);
}

EyeMovementDetector::EyeMovementDetector(Eye eye, const EventSettings& settings, const GazeAngles& angles,
                                         EventListener& listener)
    : eye_(eye), settings_(settings), angles_(angles), listener_(listener),
      onset_verify_(duration_of_ms(settings.onset_verify_ms)),
      offset_verify_(duration_of_ms(settings.offset_verify_ms)),
      blink_verify_(duration_of_ms(settings.blink_verify_ms)), window_(angles),
      recent_speed_(duration_of_ms(pursuit_window_ms)) {}

void EyeMovementDetector::push(const GazeSample& sample) {
    if (!is_a_time(sample.sampled_at))
        return;
    const TrackerClock::duration gap = duration_of_ms(longest_gap_ms);
    if (!window_.is_empty()) {
        const TrackerClock::duration since = sample.sampled_at - window_.last_at();
        if (since > gap || since < -gap)
            finish();
        else if (since <= TrackerClock::duration::zero())
            return;
    }
    window_.add(sample);
    while (const TrackedGaze* gaze = window_.next(false))
        judge(*gaze);
}

void EyeMovementDetector::finish() {
    while (const TrackedGaze* gaze = window_.next(true))
        judge(*gaze);
    if (state_ == State::saccade) {
        end_saccade();
        fixation_ = slow_;
    } else {
        fixation_.add(run_);
    }
    end_fixation();
    for (Stretch* stretch : {&fixation_, &saccade_, &run_, &slow_, &blink_})
        stretch->clear();
    state_ = State::fixation;
    has_blink_ = false;
    window_.clear();
    recent_speed_.clear();
}

EyeMovementDetector::Fastness EyeMovementDetector::fastness_of(const TrackedGaze& gaze, double speed_deg_s) {
    const double raised_by = std::min(recent_speed_.before(gaze.at), settings_.pursuit_deg_s);
    recent_speed_.add(gaze.at, speed_deg_s);
    return {speed_deg_s > settings_.velocity_deg_s + raised_by,
            settings_.acceleration_deg_s2 > 0.0 &&
                window_.acceleration_deg_s2() > settings_.acceleration_deg_s2};
}

void EyeMovementDetector::judge(const TrackedGaze& gaze) {
    if (!gaze.gaze)
        return judge_lost(gaze);
    if (has_blink_ && gaze.at - blink_.last_at > blink_verify_)
        end_blink();
    const double speed_deg_s = window_.speed_deg_s();
    const Fastness fastness = fastness_of(gaze, speed_deg_s);
    state_ == State::saccade ? judge_in_saccade(gaze, speed_deg_s, fastness.any())
                             : judge_in_fixation(gaze, speed_deg_s, fastness);
}

void EyeMovementDetector::judge_lost(const TrackedGaze& gaze) {
    if (state_ == State::fixation) {
        end_fixation();
        saccade_ = run_;
        run_.clear();
        state_ = State::saccade;
    }
    saccade_.add(slow_);
    slow_.clear();
    saccade_.add(gaze, 0.0);
    if (!has_blink_)
        blink_.clear();
    has_blink_ = true;
    blink_.add(gaze, 0.0);
}

void EyeMovementDetector::judge_in_saccade(const TrackedGaze& gaze, double speed_deg_s, bool is_fast) {
    if (is_fast) {
        saccade_.add(slow_);
        slow_.clear();
        saccade_.add(gaze, speed_deg_s);
        return;
    }
    slow_.add(gaze, speed_deg_s);
    if (slow_.last_at - slow_.first_at < offset_verify_)
        return;
    end_saccade();
    fixation_ = slow_;
    slow_.clear();
    state_ = State::fixation;
    departure_deg_ = gaze.direction_deg;
}

void EyeMovementDetector::judge_in_fixation(const TrackedGaze& gaze, double speed_deg_s, Fastness fastness) {
    if (!fastness.any()) {
        fixation_.add(run_);
        run_.clear();
        fixation_.add(gaze, speed_deg_s);
        departure_deg_ = gaze.direction_deg;
        return;
    }
    if (run_.samples == 0) {
        run_has_moved_ = run_has_speed_ = false;
        if (fixation_.samples == 0)
            departure_deg_ = gaze.direction_deg;
    }
    run_.add(gaze, speed_deg_s);
    run_has_moved_ |= glm::length(gaze.direction_deg - departure_deg_) >= settings_.motion_deg;
    run_has_speed_ |= fastness.by_speed;
    if (!run_has_moved_ || !run_has_speed_ || run_.last_at - run_.first_at < onset_verify_)
        return;
    end_fixation();
    saccade_ = run_;
    run_.clear();
    state_ = State::saccade;
}

GazeEvent EyeMovementDetector::event_of(GazeEvent::Kind kind, const Stretch& stretch) const {
    GazeEvent event;
    event.kind = kind;
    event.eye = eye_;
    event.start = stretch.first_at;
    event.end = stretch.last_at;
    event.duration = stretch.last_at - stretch.first_at + stretch.lasts;
    return event;
}

void EyeMovementDetector::end_fixation() {
    if (fixation_.valid > 0) {
        GazeEvent event = event_of(GazeEvent::Kind::fixation, fixation_);
        const glm::dvec2 mean = fixation_.sum_px / static_cast<double>(fixation_.valid);
        event.place = ScreenPoint{mean.x, mean.y};
        event.pupil = fixation_.sum_pupil / fixation_.valid;
        listener_.detected(event);
    }
    fixation_.clear();
}

void EyeMovementDetector::end_saccade() {
    if (has_blink_)
        end_blink();
    GazeEvent event = event_of(GazeEvent::Kind::saccade, saccade_);
    event.place = saccade_.first;
    event.arrival = saccade_.last;
    if (event.place) {
        event.amplitude_deg = angles_.angle_deg(*event.place, *event.arrival);
        event.peak_velocity_deg_s = saccade_.peak_deg_s;
    }
    listener_.detected(event);
    saccade_.clear();
}

void EyeMovementDetector::end_blink() {
    listener_.detected(event_of(GazeEvent::Kind::blink, blink_));
    has_blink_ = false;
}

} // namespace overt
