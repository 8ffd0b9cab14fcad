#include "experiment/session/gaze_watch.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace overt {

namespace {

/// Gaze reaches the program some milliseconds after it was measured: half a second of flips is plenty.
constexpr std::size_t kept_flips = 256;

TrackerClock::duration microseconds(double seconds) {
    return TrackerClock::duration(std::llround(1e6 * seconds));
}

} // namespace

GazeWatch::GazeWatch(const ScreenGeometry& screen, const DisplaySettings& display)
    : screen_(screen), nothing_lit_({from_seconds(1e-3 * display.latency_ms), display.refresh_hz,
                                     static_cast<double>(screen.screen_px.y)},
                                    kept_flips),
      condition_(GazeCondition::Settings()) {}

void GazeWatch::begin(const GazeWait& wait, GazeAim aim, int lead, SessionTime since,
                      std::span<const ClockPair> readings, const TrackerDescription& tracker) {
    const double interval_s = tracker.sample_rate_hz > 0.0 ? 1.0 / tracker.sample_rate_hz : 0.02;
    condition_ =
        GazeCondition({microseconds(wait.for_s), microseconds(wait.blink_s), microseconds(interval_s)});
    aim_ = std::move(aim);
    within_ = {wait.within_deg.value_or(0.0)};
    since_ = since;
    eye_ = tracker.eye;
    clock_.reset();
    if (!readings.empty())
        clock_.emplace(readings);
    lit_.assign(aim_.areas.size(), nothing_lit_);
    lead_ = lead;
    is_waiting_ = true;
    has_flipped_ = false;
}

void GazeWatch::flipped(const FlipRecord& lead, std::span<const SlotFlip> further) noexcept {
    for (std::size_t i = 0; i < lit_.size(); ++i) {
        const int place = aim_.areas[i].place;
        FlipRecord flip = lead;
        if (place != lead_)
            for (const SlotFlip& of_slot : further)
                if (of_slot.place == place)
                    flip.pose = of_slot.pose;
        lit_[i].add(flip);
    }
    if (!std::exchange(has_flipped_, true))
        since_ = std::max(since_, lead.report.vertical_blank);
}

bool GazeWatch::is_inside(const ScreenPoint& gaze, TrackerTime at) const noexcept {
    if (aim_.areas.empty())
        return screen_.angle_between(gaze, aim_.point).value <= within_.value;
    if (!clock_)
        return false;
    const SessionTime time = clock_->to_session(at).time;
    for (std::size_t i = 0; i < lit_.size(); ++i) {
        const std::optional<PoseIndex> pose = lit_[i].pose_at(time, gaze.y_px);
        if (pose && aim_.areas[i].area->is_at(*pose, gaze))
            return true;
    }
    return false;
}

void GazeWatch::take(const GazeSample& sample) noexcept {
    if (!is_waiting_ || sample.eye != eye_)
        return;
    if (clock_ && clock_->to_session(sample.sampled_at).time < since_)
        return;
    condition_.take({sample.sampled_at, sample.gaze.has_value(),
                     sample.gaze && is_inside(*sample.gaze, sample.sampled_at)});
}

} // namespace overt
