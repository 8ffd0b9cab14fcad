#include "experiment/ports/gaze_yield.h"

#include <algorithm>
#include <cmath>

namespace overt {

namespace {

constexpr double intervals_of_a_gap = 3.0, shortest_gap_s = 0.1, begins_and_ends_s = 0.5;

double seconds(TrackerClock::duration duration) { return std::chrono::duration<double>(duration).count(); }

} // namespace

void GazeYieldCount::begin(double rate_hz, int eyes_measured) noexcept {
    *this = {};
    rate_hz_ = std::max(0.0, rate_hz);
    eyes_measured_ = eyes_measured;
}

void GazeYieldCount::take(const GazeSample& sample) noexcept {
    OfEye& eye = eyes_[sample.eye == Eye::left ? 0 : 1];
    ++yield_.samples;
    yield_.without_gaze += sample.gaze ? 0 : 1;
    if (eye.last && rate_hz_ > 0.0) {
        const double gap_s = seconds(sample.sampled_at - *eye.last);
        if (gap_s > std::max(shortest_gap_s, intervals_of_a_gap / rate_hz_))
            yield_.missing += std::max<std::int64_t>(0, std::llround(gap_s * rate_hz_) - 1);
    }
    if (!eye.first)
        eye.first = sample.sampled_at;
    eye.last = sample.sampled_at;
}

GazeYield GazeYieldCount::ended_after(SessionDuration recording) const noexcept {
    GazeYield yield = yield_;
    const double all_s = std::max(0.0, to_seconds(recording));
    int eyes_seen = 0;
    double missing_s = 0.0;
    for (const OfEye& eye : eyes_) {
        if (!eye.first)
            continue;
        ++eyes_seen;
        const double outside_s = all_s - seconds(*eye.last - *eye.first);
        missing_s += outside_s > begins_and_ends_s ? outside_s : 0.0;
    }
    missing_s += all_s * std::max(0, eyes_measured_ - eyes_seen);
    yield.missing += std::llround(missing_s * rate_hz_);
    return yield;
}

} // namespace overt
