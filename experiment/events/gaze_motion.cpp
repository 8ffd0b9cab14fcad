#include "experiment/events/gaze_motion.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "experiment/events/event_settings.h"

namespace overt {
namespace {

/// There is room for this rate; of a faster tracker the windows are shorter.
constexpr double highest_rate_hz = 10'000.0;

std::size_t most_samples_within(double ms) {
    return 8 + static_cast<std::size_t>(1e-3 * ms * highest_rate_hz);
}

/// So seldom are samples moved to the front of their room.
constexpr std::size_t rooms = 8;

double seconds(TrackerClock::duration time) { return 1e-6 * static_cast<double>(time.count()); }

} // namespace

TrackerClock::duration duration_of_ms(double ms) { return TrackerClock::duration(std::llround(1e3 * ms)); }

bool is_a_time(TrackerTime at) {
    constexpr TrackerClock::duration farthest(1'000'000'000'000'000'000);
    return at.time_since_epoch() <= farthest && at.time_since_epoch() >= -farthest;
}

MotionWindow::MotionWindow(const GazeAngles& angles)
    : angles_(angles),
      samples_(rooms * most_samples_within(2.0 * std::max(velocity_window_ms, acceleration_window_ms))),
      most_(samples_.size() / rooms) {}

void MotionWindow::add(const GazeSample& sample) {
    if (end_ - begin_ == most_)
        ++begin_;
    if (end_ == samples_.size()) {
        std::move(samples_.begin() + static_cast<std::ptrdiff_t>(begin_), samples_.end(), samples_.begin());
        end_ -= begin_;
        next_ -= begin_;
        begin_ = 0;
    }
    const TrackerClock::duration lasts =
        is_empty() ? TrackerClock::duration::zero() : sample.sampled_at - last_at();
    samples_[end_++] = {sample.sampled_at, lasts, sample.gaze,
                        sample.gaze ? angles_.direction_deg(*sample.gaze) : glm::dvec3(0.0),
                        sample.pupil_area};
}

const TrackedGaze* MotionWindow::next(bool is_last) {
    const TrackerClock::duration window =
        duration_of_ms(std::max(velocity_window_ms, acceleration_window_ms));
    // What no window reaches any more is forgotten, but for the neighbour that a slow tracker needs.
    while (next_ > begin_ + 1 && next_ < end_ && samples_[begin_ + 1].at < samples_[next_].at - window)
        ++begin_;
    if (next_ == end_)
        return nullptr;
    const bool is_full = next_ + 1 < end_ && last_at() >= samples_[next_].at + window;
    // Of a tracker that is faster than there is room for, both halves of the window are shortened.
    const bool has_no_room = end_ - begin_ == most_ && next_ - begin_ < most_ / 2;
    if (!is_last && !is_full && !has_no_room)
        return nullptr;
    return &samples_[next_++];
}

MotionWindow::Range MotionWindow::samples_within(TrackerClock::duration window) const {
    const std::size_t i = next_ - 1;
    const TrackerTime earliest = samples_[i].at - window, latest = samples_[i].at + window;
    Range range{i, i};
    while (range.from > begin_ && samples_[range.from - 1].gaze && samples_[range.from - 1].at >= earliest)
        --range.from;
    while (range.to + 1 < end_ && samples_[range.to + 1].gaze && samples_[range.to + 1].at <= latest)
        ++range.to;
    return range;
}

double MotionWindow::speed_between(std::size_t a, std::size_t b) const {
    if (!samples_[a].gaze || !samples_[b].gaze)
        return 0.0;
    return glm::length(samples_[b].direction_deg - samples_[a].direction_deg) /
           seconds(samples_[b].at - samples_[a].at);
}

double MotionWindow::speed_deg_s() const {
    const std::size_t i = next_ - 1;
    const Range range = samples_within(duration_of_ms(velocity_window_ms));
    if (range.from == range.to)
        return std::max(i > begin_ ? speed_between(i - 1, i) : 0.0,
                        i + 1 < end_ ? speed_between(i, i + 1) : 0.0);
    double t1 = 0.0, t2 = 0.0;
    glm::dvec3 d0(0.0), d1(0.0);
    for (std::size_t k = range.from; k <= range.to; ++k) {
        const double t = seconds(samples_[k].at - samples_[i].at);
        const glm::dvec3 d = samples_[k].direction_deg - samples_[i].direction_deg;
        t1 += t;
        t2 += t * t;
        d0 += d;
        d1 += t * d;
    }
    return glm::length((range.count() * d1 - t1 * d0) / (range.count() * t2 - t1 * t1));
}

/// Twice the quadratic coefficient of the parabola, by Cramer's rule on its normal equations.
double MotionWindow::acceleration_deg_s2() const {
    const std::size_t i = next_ - 1;
    const Range range = samples_within(duration_of_ms(acceleration_window_ms));
    const double n = range.count();
    // Fewer would tell their noise. The error of a curvature grows with the inverse fifth half power of the
    // time that it is taken over: where a recording begins, ends or loses the eye, half a window would give
    // six times as much.
    constexpr double fewest_samples = 5.0, least_windows = 1.5;
    if (n < fewest_samples || samples_[range.to].at - samples_[range.from].at <
                                  duration_of_ms(least_windows * acceleration_window_ms))
        return 0.0;
    double t1 = 0.0, t2 = 0.0, t3 = 0.0, t4 = 0.0;
    glm::dvec3 d0(0.0), d1(0.0), d2(0.0);
    for (std::size_t k = range.from; k <= range.to; ++k) {
        const double t = seconds(samples_[k].at - samples_[i].at), tt = t * t;
        const glm::dvec3 d = samples_[k].direction_deg - samples_[i].direction_deg;
        t1 += t;
        t2 += tt;
        t3 += t * tt;
        t4 += tt * tt;
        d0 += d;
        d1 += t * d;
        d2 += tt * d;
    }
    const double spread = n * t2 - t1 * t1;
    const double determinant = n * (t2 * t4 - t3 * t3) - t1 * (t1 * t4 - t2 * t3) + t2 * (t1 * t3 - t2 * t2);
    const glm::dvec3 numerator = d0 * (t1 * t3 - t2 * t2) - d1 * (n * t3 - t1 * t2) + d2 * spread;
    return 2.0 * glm::length(numerator / determinant);
}

MeanSpeed::MeanSpeed(TrackerClock::duration window)
    : window_(window), times_(rooms * most_samples_within(1e3 * seconds(window))),
      speeds_deg_s_(times_.size()) {}

double MeanSpeed::before(TrackerTime now) {
    while (begin_ < end_ && times_[begin_] < now - window_)
        ++begin_;
    if (begin_ == end_)
        return 0.0;
    const auto first = speeds_deg_s_.begin() + static_cast<std::ptrdiff_t>(begin_);
    const auto behind = speeds_deg_s_.begin() + static_cast<std::ptrdiff_t>(end_);
    return std::accumulate(first, behind, 0.0) / static_cast<double>(end_ - begin_);
}

void MeanSpeed::add(TrackerTime at, double speed_deg_s) {
    if (end_ - begin_ == times_.size() / rooms)
        ++begin_;
    if (end_ == times_.size()) {
        const auto from = static_cast<std::ptrdiff_t>(begin_);
        std::move(times_.begin() + from, times_.end(), times_.begin());
        std::move(speeds_deg_s_.begin() + from, speeds_deg_s_.end(), speeds_deg_s_.begin());
        end_ -= begin_;
        begin_ = 0;
    }
    times_[end_] = at;
    speeds_deg_s_[end_++] = speed_deg_s;
}

} // namespace overt
