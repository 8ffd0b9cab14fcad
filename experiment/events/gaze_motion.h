/// Velocity and acceleration of the eye, from samples that come one by one.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include "experiment/events/gaze_angles.h"
#include "experiment/gaze.h"

namespace overt {

/// A sample with its direction.
struct TrackedGaze {
    TrackerTime at;
    TrackerClock::duration lasts{};  ///< time to the sample before it; of the first one 0
    std::optional<ScreenPoint> gaze; ///< nothing: lost
    glm::dvec3 direction_deg{0.0};   ///< of gaze
    float pupil = 0.0f;
};

TrackerClock::duration duration_of_ms(double ms);

/// Whether differences of times with this one cannot overflow: what a damaged recording holds beyond 30,000
/// years is left out.
bool is_a_time(TrackerTime at);

/// Samples around the one that is looked at. Each becomes ready when its window is full, and then has the
/// motion that the samples around it tell: the slope of the line of least squares through the directions
/// within velocity_window_ms, and twice the curvature of the parabola within acceleration_window_ms. Samples
/// beyond a lost one do not count. Of a tracker whose samples are further apart than the window, the speed is
/// the higher one of those to both neighbours. With few samples, or samples over a short time, there is no
/// acceleration, for it would consist of their noise. Allocates only in the constructor.
class MotionWindow {
  public:
    explicit MotionWindow(const GazeAngles& angles);

    /// Later than all before it.
    void add(const GazeSample& sample);

    bool is_empty() const { return begin_ == end_; }
    TrackerTime last_at() const { return samples_[end_ - 1].at; } ///< not of an empty one

    /// The next sample whose window is full, or, if there will be no more, that is left; null if there is
    /// none. Valid until the next call.
    const TrackedGaze* next(bool is_last);
    // Of the one that next() gave.
    double speed_deg_s() const;
    double acceleration_deg_s2() const; ///< size of the vector

    void clear() { begin_ = end_ = next_ = 0; }

  private:
    struct Range {
        std::size_t from, to;
        double count() const { return static_cast<double>(to - from + 1); }
    };
    Range samples_within(TrackerClock::duration window) const;
    double speed_between(std::size_t a, std::size_t b) const;

    GazeAngles angles_;
    std::vector<TrackedGaze>
        samples_;      ///< begin_ … end_ - 1; moved to the front when the room behind them is used up
    std::size_t most_; ///< samples that are kept
    std::size_t begin_ = 0, end_ = 0, next_ = 0;
};

/// The mean of the speeds within a time before now. Allocates only in the constructor.
class MeanSpeed {
  public:
    explicit MeanSpeed(TrackerClock::duration window);
    /// Of those before `now`; 0 if there are none.
    double before(TrackerTime now);
    void add(TrackerTime at, double speed_deg_s);
    void clear() { begin_ = end_ = 0; }

  private:
    TrackerClock::duration window_;
    std::vector<TrackerTime> times_;
    std::vector<double> speeds_deg_s_; ///< begin_ … end_ - 1
    std::size_t begin_ = 0, end_ = 0;
};

} // namespace overt
