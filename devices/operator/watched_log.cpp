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

void WatchedLog::tell_frame(int trial, int place, AnimationFrameIndex shown, PoseIndex pose,
                            int refresh) noexcept {
    const auto index = static_cast<std::size_t>(place);
    if (index >= told_frames_.size() || shown.value == told_frames_[index])
        return;
    told_frames_[index] = shown.value;
    tell({.kind = ViewNews::Kind::flip,
          .trial = trial,
          .shown = place,
          .pose = shown == no_frame ? -1 : pose.value,
          .frame = shown.value,
          .refresh = refresh,
          .at = last_blank_});
}

void WatchedLog::flip(const FlipRecord& flip) noexcept {
    record_.flip(flip);
    last_blank_ = flip.report.vertical_blank;
    tell_frame(flip.trial, 0, flip.shown, flip.pose, flip.refresh_in_trial);
}

void WatchedLog::slot_flip(const SlotFlip& flip) noexcept {
    record_.slot_flip(flip);
    tell_frame(flip.trial, flip.place, flip.shown, flip.pose, flip.refresh_in_trial);
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
    told_frames_.assign(trial.shown_count(), -1);
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
