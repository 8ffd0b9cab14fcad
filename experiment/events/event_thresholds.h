/// The thresholds by which events are found in a recording: what a person chose, and the usual ones for gaze
/// that is sampled so fast and is so noisy.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "experiment/events/event_settings.h"
#include "experiment/events/gaze_motion.h"

namespace overt {

/// A threshold by its key, as a protocol's [events] and the options of commands name it.
struct EventThreshold {
    std::string_view key;
    double EventSettings::*setting;
    double least, most;
    std::string_view unit, what; ///< a whole sentence
};

/// The one table of them.
inline constexpr std::array event_thresholds{
    EventThreshold{"velocity_deg_s", &EventSettings::velocity_deg_s, 1, 1000, "deg/s",
                   "An eye that is faster makes a saccade."},
    EventThreshold{
        "acceleration_deg_s2", &EventSettings::acceleration_deg_s2, 0, 1e6, "deg/s2",
        "Or one whose velocity changes faster; 0: velocity alone decides, which ends saccades where people "
        "who label raw gaze end them."},
    EventThreshold{"motion_deg", &EventSettings::motion_deg, 0, 10, "deg",
                   "What moves the eye less far is no saccade."},
    EventThreshold{
        "pursuit_deg_s", &EventSettings::pursuit_deg_s, 0, 1000, "deg/s",
        "By so much at most `velocity_deg_s` is raised while the eye moves anyway: by its mean speed of the "
        "last 40 ms. 0: it stays as it is."},
    EventThreshold{"onset_verify_ms", &EventSettings::onset_verify_ms, 0, 1000, "ms",
                   "For so long the eye has to be fast for a saccade."},
    EventThreshold{"offset_verify_ms", &EventSettings::offset_verify_ms, 0, 1000, "ms",
                   "For so long it has to be slow for the saccade's end."},
    EventThreshold{"blink_verify_ms", &EventSettings::blink_verify_ms, 0, 1000, "ms",
                   "For so long the pupil has to be there for the end of a blink."},
};

/// Those that somebody chose, in the order of the table; nothing: the usual one.
struct ChosenThresholds {
    std::array<std::optional<double>, event_thresholds.size()> values{};

    EventSettings over(EventSettings usual) const;
    bool operator==(const ChosenThresholds&) const = default;
};

/// How closely gaze is sampled, and how noisy it is.
struct GazeNoise {
    double interval_ms = 0.0; ///< median between samples of one eye
    /// Median of the speeds that the samples around each tell (MotionWindow): fixations take most of the
    /// time, and in them the eye is as fast as its noise.
    double speed_deg_s = 0.0;
    bool operator==(const GazeNoise&) const = default;
};

/// Measures both from samples of either eye, in the order of their times. Memory does not grow with them.
class GazeNoiseMeter {
  public:
    explicit GazeNoiseMeter(const GazeAngles& angles);
    /// As EyeMovementDetector::push().
    void push(const GazeSample& sample);
    /// What follows is another recording.
    void finish();
    /// After finish(). Nothing of fewer than two samples of an eye.
    std::optional<GazeNoise> measured() const;

  private:
    /// Counts of values by the nearest step of one size; those beyond the last step count to it.
    class Counts {
      public:
        Counts(double step, double most) : step_(step), counts_(static_cast<std::size_t>(most / step) + 1) {}
        void add(double value);
        std::optional<double> median() const;

      private:
        double step_;
        std::vector<std::int64_t> counts_;
        std::int64_t all_ = 0;
    };
    void take(MotionWindow& window, bool is_last);

    std::array<MotionWindow, 2> eyes_;
    Counts intervals_ms_, speeds_deg_s_;
};

/// The thresholds for gaze of this rate and noise. They depend on nothing else.
/// - Velocity: 35 deg/s less the median speed, 27 to 31 deg/s, for it is raised by the mean speed of the last
///   40 ms, which in a quiet eye is noise. Where samples lie more than 7 ms apart, less in proportion: a
///   saccade then shows the mean speed between samples, not its peak. Never less than twice the median speed.
/// - Acceleration: 8000 deg/s2. Where the median speed is more than 8 deg/s (at 500 Hz and more; below in
///   proportion to the interval), more with the fourth power of it, so that it soon decides nothing: in noisy
///   gaze it is the noise, and the swing at a saccade's end, that change velocity so fast.
/// Chosen on a part of the recordings of docs/events.md, which tells how they do on the rest.
EventSettings usual_settings(const GazeNoise& noise);

/// What is put on record of a detection in a recording with these settings: also what was measured.
EventDetection detection_by(const EventSettings& settings, const std::optional<GazeNoise>& measured);

} // namespace overt
