/// Gaze as it is planted in tests: samples of one eye that rests, moves and is lost.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "experiment/events/planted_gaze.h"
#include "experiment/gaze.h"
#include "experiment/screen_geometry.h"

namespace overt::testing {

inline const ScreenGeometry screen;
inline const GazeAngles angles(screen);

/// A place that many degrees to the right of the screen's middle, and below it.
inline ScreenPoint place(double right_deg, double down_deg = 0.0) {
    const auto px = [&](double deg, int axis) {
        return std::tan(to_radians({deg}).value) * screen.viewing_distance_mm * screen.screen_px[axis] /
               screen.screen_mm[axis];
    };
    return {screen.centre().x_px + px(right_deg, 0), screen.centre().y_px + px(down_deg, 1)};
}

/// Samples of one eye at a rate, one after the other.
class Trace {
  public:
    explicit Trace(double rate_hz) : rate_hz_(rate_hz) {}

    Trace& rest(double seconds, double right_deg, double down_deg = 0.0) {
        return move(seconds, [=](double) { return place(right_deg, down_deg); });
    }
    /// At a steady speed.
    Trace& glide(double seconds, double from_deg, double to_deg) {
        return move(seconds, [=](double share) { return place(from_deg + share * (to_deg - from_deg)); });
    }
    Trace& lose(double seconds) {
        for (const std::size_t end = samples.size() + count(seconds); samples.size() < end;)
            samples.push_back({next(), Eye::right, std::nullopt, 0.0f});
        return *this;
    }
    Trace& skip(double seconds) {
        skipped_us_ += std::llround(1e6 * seconds);
        return *this;
    }
    std::vector<GazeSample> samples;

  private:
    template <class At> Trace& move(double seconds, const At& at) {
        const std::size_t steps = count(seconds);
        for (std::size_t i = 0; i < steps; ++i)
            samples.push_back(
                {next(), Eye::right, at(static_cast<double>(i + 1) / static_cast<double>(steps)), 900.0f});
        return *this;
    }
    std::size_t count(double seconds) const {
        return static_cast<std::size_t>(std::llround(seconds * rate_hz_));
    }
    TrackerTime next() const {
        return tracker_time(std::llround(1e6 * static_cast<double>(samples.size()) / rate_hz_) + skipped_us_);
    }
    double rate_hz_;
    std::int64_t skipped_us_ = 0;
};

inline PlantedGaze planted_at(double rate_hz, double noise_deg = 0.02, double seconds = 60.0) {
    return plant_gaze({.rate_hz = rate_hz, .duration_s = seconds, .noise_deg = noise_deg}, screen);
}

} // namespace overt::testing
