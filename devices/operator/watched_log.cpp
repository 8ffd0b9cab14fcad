#include "devices/operator/watched_log.h"

#include "experiment/ports/event_kinds.h"

namespace overt {

namespace {

/// Of samples, what a ring has room for.
constexpr TrackerClock::duration between_counts = std::chrono::milliseconds(15);
constexpr SessionDuration between_levels = std::chrono::milliseconds(50);

} // namespace

void WatchedLog::tell(ViewNews news) const noexcept {
    news.samples = samples_;
    news.lost = lost_;
    news.samples_in_trial = samples_in_trial_;
    news.lost_in_trial = lost_in_trial_;
    news.missed = missed_;
    news.missed_in_trial = missed_in_trial_;
    server_.push(news);
}

void WatchedLog::flip(const FlipRecord& flip) noexcept {
    record_.flip(flip);
    if (flip.shown.value == told_frame_)
        return;
    told_frame_ = flip.shown.value;
    tell({.kind = ViewNews::Kind::flip,
          .trial = flip.trial,
          .pose = flip.shown == no_frame ? -1 : flip.pose.value,
          .frame = flip.shown.value,
          .refresh = flip.refresh_in_trial,
          .at = flip.report.vertical_blank});
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
    tell({.kind = ViewNews::Kind::samples, .trial = trial, .at = clock_.now()});
}

void WatchedLog::event(const SessionEvent& event) {
    record_.event(event);
    if (event.kind == operator_pressed_event)
        panel_.acted_on(event.detail);
    ViewNews news{.kind = ViewNews::Kind::event, .trial = event.trial, .at = event.at};
    news.set_word(event.kind);
    news.set_text(event.detail);
    tell(news);
}

void WatchedLog::calibration(const RecordedCalibration& calibration) {
    record_.calibration(calibration);
    tell({.kind = ViewNews::Kind::validation,
          .trial = calibration.trial,
          .at = calibration.at,
          .value = calibration.validation.mean_error.value,
          .other = calibration.validation.max_error.value});
}

void WatchedLog::trial_started(const Trial& trial, SessionTime at) {
    record_.trial_started(trial, at);
    samples_in_trial_ = lost_in_trial_ = missed_in_trial_ = 0;
    told_frame_ = -1;
    tell({.kind = ViewNews::Kind::trial_started, .trial = trial.index, .at = at});
}

void WatchedLog::trial_finished(const Trial& trial, const TrialOutcome& outcome) {
    record_.trial_finished(trial, outcome);
    ViewNews news{.kind = ViewNews::Kind::trial_ended,
                  .counts = outcome.status == TrialOutcome::Status::completed,
                  .has_value = outcome.drift.has_value(),
                  .trial = trial.index,
                  .at = clock_.now(),
                  .value = outcome.drift ? outcome.drift->value : 0.0};
    news.set_text(outcome.answer);
    tell(news);
}

void WatchedLog::entered(SessionPhase phase, int trial) noexcept {
    tell({.kind = ViewNews::Kind::phase, .phase = phase, .trial = trial, .at = clock_.now()});
}

void WatchedLog::level(const AudioLevel& level) noexcept {
    const SessionTime now = clock_.now();
    if (told_level_ && now - *told_level_ < between_levels)
        return;
    told_level_ = now;
    tell({.kind = ViewNews::Kind::level,
          .counts = level.is_clipping,
          .at = now,
          .value = static_cast<double>(level.rms),
          .other = static_cast<double>(level.peak)});
}

} // namespace overt
