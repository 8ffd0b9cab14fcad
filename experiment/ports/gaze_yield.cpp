#include "experiment/ports/gaze_yield.h"

#include <algorithm>
#include <cmath>

namespace overt {

namespace {

constexpr double intervals_of_a_gap = 3.0, shortest_gap_s = 0.1, begins_and_ends_s = 0.5;

double seconds(TrackerClock::duration duration) { return std::chrono::duration<double>(duration).count(); }

} // namespace

void GazeYieldCount::begin(double rate_hz, std::array<bool, 2> eyes_measured) noexcept {
    *this = {};
    rate_hz_ = std::max(0.0, rate_hz);
    for (std::size_t eye = 0; eye < eyes_.size(); ++eye)
        eyes_[eye].is_measured = eyes_measured[eye];
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
    for (const OfEye& eye : eyes_) {
        if (!eye.is_measured)
            continue;
        const double all_s = to_seconds(recording);
        const double covered_s = eye.first ? seconds(*eye.last - *eye.first) : 0.0;
        if (!eye.first || all_s - covered_s > begins_and_ends_s)
            yield.missing += std::llround(std::max(0.0, all_s - covered_s) * rate_hz_);
    }
    return yield;
}

} // namespace overt
