#include "devices/opengaze/opengaze_samples.h"

namespace overt {
namespace {

constexpr SessionDuration between_clock_readings = std::chrono::seconds(1);

/// A counter that jumps farther has been set anew.
constexpr std::int64_t longest_gap = 1'000'000;

SessionDuration since_tracker_time(const ClockPair& pair) noexcept {
    return pair.after.time_since_epoch() - SessionDuration(pair.other.time_since_epoch());
}

} // namespace

OpenGazeSamples::OpenGazeSamples(const TrackerWish& wish, TrackedPoint point,
                                 SessionDuration longest_delay) noexcept
    : screen_px_(wish.screen.screen_px), eye_(wish.eye),
      both_eyes_(wish.both_eyes && point == TrackedPoint::eyes), point_(point),
      longest_delay_(longest_delay) {}

void OpenGazeSamples::begin() noexcept {
    counter_.reset();
    last_arrival_.reset();
    clocks_since_.reset();
    was_noise_ = false;
}

void OpenGazeSamples::put_eye(Eye eye, const OpenGazeEye& measured, TrackerItemSink& sink) const noexcept {
    GazeSample sample;
    sample.sampled_at = last_time_;
    sample.eye = eye;
    if (measured.gaze) {
        const glm::dvec2 place = *measured.gaze * screen_px_;
        sample.gaze = ScreenPoint{place.x, place.y};
    }
    // Millimetres always: pixels of the camera would be another unit wherever those are missing.
    if (measured.pupil_mm)
        sample.pupil_area = static_cast<float>(*measured.pupil_mm);
    sink.put(sample);
    if (measured.eye_mm) {
        SampleDetail detail;
        detail.sampled_at = last_time_;
        detail.eye = eye;
        detail.eye_mm = measured.eye_mm;
        sink.put(detail);
    }
}

void OpenGazeSamples::take(const OpenGazeRecord& record, SessionTime arrived, OpenGazeClock& clock,
                           TrackerItemSink& sink) noexcept {
    last_arrival_ = arrived;
    const std::optional<TrackerTime> time = clock.time_of(record, arrived);
    if (!time) {
        take_noise(sink);
        return;
    }
    if (record.counter) {
        // A line that could not be read was told of already.
        const std::int64_t told = was_noise_ ? 1 : 0;
        if (counter_ && *record.counter > *counter_ + 1 + told && *record.counter - *counter_ < longest_gap)
            sink.put(
                TrackerGap{TrackerGap::Reason::overflow, last_time_, *record.counter - *counter_ - 1 - told});
        counter_ = record.counter;
    }
    was_noise_ = false;
    last_time_ = *time;
    if (point_ == TrackedPoint::best) {
        OpenGazeEye best = eye_ == Eye::left ? record.left : record.right;
        best.gaze = record.best;
        put_eye(eye_, best, sink);
    } else {
        if (both_eyes_ || eye_ == Eye::left)
            put_eye(Eye::left, record.left, sink);
        if (both_eyes_ || eye_ == Eye::right)
            put_eye(Eye::right, record.right, sink);
    }
    read_clocks(arrived, sink);
}

void OpenGazeSamples::take_noise(TrackerItemSink& sink) noexcept {
    sink.put(TrackerGap{TrackerGap::Reason::unreadable, last_time_, 1});
    was_noise_ = true;
}

void OpenGazeSamples::read_clocks(SessionTime arrived, TrackerItemSink& sink) noexcept {
    const ClockPair pair{arrived - longest_delay_, last_time_, arrived};
    if (!clocks_since_ || since_tracker_time(pair) < since_tracker_time(soonest_))
        soonest_ = pair;
    if (!clocks_since_) {
        clocks_since_ = arrived;
        sink.put(soonest_); // so that a recording of less than a second has one
    } else if (arrived - *clocks_since_ >= between_clock_readings) {
        sink.put(soonest_);
        clocks_since_ = arrived;
        soonest_ = pair;
    }
}

} // namespace overt
