#include "devices/operator/watched_log.h"

#include "experiment/ports/event_kinds.h"

namespace overt {

namespace {

/// Of samples, what a ring has room for.
constexpr TrackerClock::duration between_counts = std::chrono::milliseconds(15);
constexpr SessionDuration between_levels = std::chrono::milliseconds(50);

} // namespace

void WatchedLog::add_counts(ViewNews& news) const noexcept {
    news.samples = samples_;
    news.lost = lost_;
    news.samples_in_trial = samples_in_trial_;
    news.lost_in_trial = lost_in_trial_;
    news.missed = missed_;
    news.missed_in_trial = missed_in_trial_;
}

void WatchedLog::flip(const FlipRecord& flip) noexcept {
    record_.flip(flip);
    if (flip.pose.value == told_pose_)
        return;
    told_pose_ = flip.pose.value;
    ViewNews news;
    news.kind = ViewNews::Kind::flip;
    news.at = flip.report.vertical_blank;
    news.trial = flip.trial;
    news.pose = flip.pose.value;
    news.refresh = flip.refresh_in_trial;
    add_counts(news);
    server_.push(news);
}

void WatchedLog::missed(const MissedRefresh& refresh) noexcept {
    record_.missed(refresh);
    ++missed_;
    ++missed_in_trial_;
}

void WatchedLog::sample(int trial, const GazeSample& sample) noexcept {
    record_.sample(trial, sample);
    ++samples_;
    ++samples_in_trial_;
    lost_ += sample.gaze ? 0 : 1;
    lost_in_trial_ += sample.gaze ? 0 : 1;
    if (gaze_)
        gaze_->measured(sample);
    if (told_samples_ && sample.sampled_at >= *told_samples_ &&
        sample.sampled_at - *told_samples_ < between_counts)
        return;
    told_samples_ = sample.sampled_at;
    ViewNews news;
    news.kind = ViewNews::Kind::samples;
    news.at = clock_.now();
    news.trial = trial;
    add_counts(news);
    server_.push(news);
}

void WatchedLog::event(const SessionEvent& event) {
    record_.event(event);
    if (event.kind == operator_pressed_event)
        panel_.acted_on(event.detail);
    ViewNews news;
    news.kind = ViewNews::Kind::event;
    news.at = event.at;
    news.trial = event.trial;
    news.set_word(event.kind);
    news.set_text(event.detail);
    server_.push(news);
}

void WatchedLog::calibration(const RecordedCalibration& calibration) {
    record_.calibration(calibration);
    ViewNews news;
    news.kind = ViewNews::Kind::validation;
    news.at = calibration.at;
    news.trial = calibration.trial;
    news.value = calibration.validation.mean_error.value;
    news.other = calibration.validation.max_error.value;
    server_.push(news);
}

void WatchedLog::trial_started(const Trial& trial, SessionTime at) {
    record_.trial_started(trial, at);
    samples_in_trial_ = lost_in_trial_ = missed_in_trial_ = 0;
    told_pose_ = -1;
    ViewNews news;
    news.kind = ViewNews::Kind::trial_started;
    news.at = at;
    news.trial = trial.index;
    server_.push(news);
}

void WatchedLog::trial_finished(const Trial& trial, const TrialOutcome& outcome) {
    record_.trial_finished(trial, outcome);
    ViewNews news;
    news.kind = ViewNews::Kind::trial_ended;
    news.at = clock_.now();
    news.trial = trial.index;
    news.counts = outcome.status == TrialOutcome::Status::completed;
    news.has_value = outcome.drift.has_value();
    if (outcome.drift)
        news.value = outcome.drift->value;
    news.set_text(outcome.answer);
    add_counts(news);
    server_.push(news);
}

void WatchedLog::entered(SessionPhase phase, int trial) noexcept {
    ViewNews news;
    news.kind = ViewNews::Kind::phase;
    news.at = clock_.now();
    news.phase = phase;
    news.trial = trial;
    server_.push(news);
}

void WatchedLog::level(const AudioLevel& level) noexcept {
    const SessionTime now = clock_.now();
    if (told_level_ && now - *told_level_ < between_levels)
        return;
    told_level_ = now;
    ViewNews news;
    news.kind = ViewNews::Kind::level;
    news.at = now;
    news.value = static_cast<double>(level.rms);
    news.other = static_cast<double>(level.peak);
    news.counts = level.is_clipping;
    server_.push(news);
}

} // namespace overt
