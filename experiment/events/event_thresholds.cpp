#include "experiment/events/event_thresholds.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

namespace overt {
namespace {

// Of a quiet eye: the threshold is raised by the mean speed of the last 40 ms, which is its noise then.
constexpr double raised_velocity_deg_s = 35.0;
constexpr double least_velocity_deg_s = 27.0, most_velocity_deg_s = 31.0;
constexpr double widest_interval_ms = 7.0;
constexpr double least_times_noise = 2.0;

constexpr double usual_acceleration_deg_s2 = 8000.0;
// At 500 Hz and more.
constexpr double calm_noise_deg_s = 8.0, calm_interval_ms = 2.0;
constexpr double most_acceleration_deg_s2 = 1e6; // which no eye reaches

/// To the decimals that read well, and are far finer than thresholds are known; -2: to hundreds.
double rounded(double value, int decimals) {
    const double power = std::pow(10.0, std::abs(decimals));
    return decimals < 0 ? power * std::round(value / power) : std::round(value * power) / power;
}

} // namespace

EventSettings ChosenThresholds::over(EventSettings usual) const {
    for (std::size_t i = 0; i < values.size(); ++i)
        if (values[i])
            usual.*event_thresholds[i].setting = *values[i];
    return usual;
}

void GazeNoiseMeter::Counts::add(double value) {
    const double step = std::clamp(std::round(value / step_), 0.0, static_cast<double>(counts_.size() - 1));
    ++counts_[static_cast<std::size_t>(step)];
    ++all_;
}

std::optional<double> GazeNoiseMeter::Counts::median() const {
    if (all_ == 0)
        return std::nullopt;
    std::int64_t before = 0;
    std::size_t i = 0;
    while (2 * (before + counts_[i]) < all_)
        before += counts_[i++];
    return step_ * static_cast<double>(i);
}

GazeNoiseMeter::GazeNoiseMeter(const GazeAngles& angles)
    : eyes_{MotionWindow(angles), MotionWindow(angles)}, intervals_ms_(0.01, longest_gap_ms),
      speeds_deg_s_(0.02, 500.0) {}

void GazeNoiseMeter::take(MotionWindow& window, bool is_last) {
    while (const TrackedGaze* gaze = window.next(is_last))
        if (gaze->gaze)
            speeds_deg_s_.add(window.speed_deg_s());
}

void GazeNoiseMeter::push(const GazeSample& sample) {
    if (!is_a_time(sample.sampled_at))
        return;
    MotionWindow& window = eyes_[static_cast<std::size_t>(sample.eye)];
    if (!window.is_empty()) {
        const TrackerClock::duration since = sample.sampled_at - window.last_at();
        const TrackerClock::duration gap = duration_of_ms(longest_gap_ms);
        if (since > gap || since < -gap) {
            take(window, true);
            window.clear();
        } else if (since <= TrackerClock::duration::zero()) {
            return;
        } else {
            intervals_ms_.add(std::chrono::duration<double, std::milli>(since).count());
        }
    }
    window.add(sample);
    take(window, false);
}

void GazeNoiseMeter::finish() {
    for (MotionWindow& window : eyes_) {
        take(window, true);
        window.clear();
    }
}

std::optional<GazeNoise> GazeNoiseMeter::measured() const {
    const std::optional<double> interval_ms = intervals_ms_.median(), speed_deg_s = speeds_deg_s_.median();
    if (!interval_ms || !speed_deg_s)
        return std::nullopt;
    return GazeNoise{rounded(*interval_ms, 2), rounded(*speed_deg_s, 1)};
}

EventSettings usual_settings(const GazeNoise& noise) {
    EventSettings settings;
    const double fast_deg_s =
        std::clamp(raised_velocity_deg_s - noise.speed_deg_s, least_velocity_deg_s, most_velocity_deg_s);
    const double seen = std::min(1.0, widest_interval_ms / noise.interval_ms);
    settings.velocity_deg_s = rounded(std::max(fast_deg_s * seen, least_times_noise * noise.speed_deg_s), 1);
    const double calm_deg_s = calm_noise_deg_s * std::max(1.0, noise.interval_ms / calm_interval_ms);
    const double excess = std::max(1.0, noise.speed_deg_s / calm_deg_s);
    settings.acceleration_deg_s2 =
        rounded(std::min(usual_acceleration_deg_s2 * std::pow(excess, 4), most_acceleration_deg_s2), -2);
    return settings;
}

EventDetection detection_by(const EventSettings& settings, const std::optional<GazeNoise>& measured) {
    EventDetection detection = detection_by(settings);
    if (measured) {
        detection.parameters.pop_back(); // the object's end
        detection.parameters +=
            fmt::format(R"(,"measured_interval_ms":{:.6g},"measured_speed_deg_s":{:.6g}}})",
                        measured->interval_ms, measured->speed_deg_s);
    }
    return detection;
}

} // namespace overt
