#include "devices/pupil/pupil_samples.h"

#include <algorithm>
#include <cmath>

#include "devices/tracker/tracker_seconds.h"

namespace overt {
namespace {

/// A pupil belongs to a gaze if it was measured within this of it: two pictures of a camera of 60 Hz.
constexpr double pupil_reach_s = 0.034;

} // namespace

PupilSamples::PupilSamples(Eye eye, bool both_eyes, const SurfaceOnScreen& surface,
                           double least_confidence) noexcept
    : eye_(eye), both_eyes_(both_eyes), surface_(surface), least_confidence_(least_confidence) {}

PupilSamples::PupilSamples(const TrackerWish& wish, const SurfaceOnScreen& surface,
                           double least_confidence) noexcept
    : PupilSamples(wish.eye, wish.both_eyes, surface, least_confidence) {}

void PupilHistory::take(const PupilDatum& pupil) noexcept {
    PupilDatum* known = nullptr;
    for (std::size_t i = 0; i < count_ && !known; ++i)
        if (pupils_[i].time_s == pupil.time_s)
            known = &pupils_[i];
    if (!known) {
        pupils_[next_] = pupil;
        next_ = (next_ + 1) % pupils_.size();
        count_ = std::min(count_ + 1, pupils_.size());
        return;
    }
    PupilDatum merged = pupil;
    if (!merged.diameter_mm)
        merged.diameter_mm = known->diameter_mm;
    if (!merged.eye_mm)
        merged.eye_mm = known->eye_mm;
    *known = merged;
}

const PupilDatum* PupilHistory::nearest(double time_s) const noexcept {
    const PupilDatum* best = nullptr;
    for (std::size_t i = 0; i < count_; ++i) {
        const double apart_s = std::abs(pupils_[i].time_s - time_s);
        if (apart_s <= pupil_reach_s && (!best || apart_s < std::abs(best->time_s - time_s)))
            best = &pupils_[i];
    }
    return best;
}

void PupilSamples::take(const PupilDatum& pupil) noexcept {
    pupils_[static_cast<std::size_t>(pupil.eye)].take(pupil);
}

void PupilSamples::put_eye(Eye eye, const SurfaceGaze& gaze, bool is_its_own,
                           TrackerItemSink& sink) const noexcept {
    GazeSample sample;
    sample.sampled_at = last_time_;
    sample.eye = eye;
    if (is_its_own && gaze.confidence >= least_confidence_)
        sample.gaze = surface_.on_screen(gaze.place);
    SampleDetail detail;
    detail.sampled_at = last_time_;
    detail.eye = eye;
    detail.confidence = is_its_own ? static_cast<float>(gaze.confidence) : 0.0f;
    const PupilDatum* const pupil = pupils_[static_cast<std::size_t>(eye)].nearest(gaze.time_s);
    if (pupil && pupil->confidence >= least_confidence_) {
        if (pupil->diameter_mm)
            sample.pupil_area = static_cast<float>(*pupil->diameter_mm);
        detail.eye_mm = pupil->eye_mm;
    }
    sink.put(sample);
    sink.put(detail);
}

void PupilSamples::take(const SurfaceGaze& gaze, TrackerItemSink& sink) noexcept {
    const std::optional<TrackerTime> time = tracker_time_of_seconds(gaze.time_s);
    if (!time)
        return take_noise(sink);
    if (has_time_ && *time <= last_time_)
        return;
    has_time_ = true;
    last_time_ = *time;
    if (both_eyes_ || eye_ == Eye::left)
        put_eye(Eye::left, gaze, gaze.from_left, sink);
    if (both_eyes_ || eye_ == Eye::right)
        put_eye(Eye::right, gaze, gaze.from_right, sink);
}

void PupilSamples::take_noise(TrackerItemSink& sink) const noexcept {
    sink.put(TrackerGap{TrackerGap::Reason::unreadable, last_time_, 0});
}

} // namespace overt
