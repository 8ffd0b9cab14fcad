/// What decides between fixation, saccade and blink.
#pragma once

#include <string>
#include <string_view>

namespace overt {

/// The thresholds of the parser, with those of an EyeLink's "cognitive" configuration as defaults (EyeLink
/// 1000 user manual, sections 4.3.5 to 4.3.9; the initialisation files' saccade_velocity_threshold,
/// saccade_acceleration_threshold, saccade_motion_threshold, saccade_pursuit_fixup,
/// saccade_onset_verify_time, saccade_offset_verify_time and blink_offset_verify_time).
struct EventSettings {
    double velocity_deg_s = 30.0; ///< an eye that is faster makes a saccade
    /// Or one whose velocity changes faster; 0: velocity alone decides. Made for gaze that the tracker has
    /// smoothed, as an EyeLink does: in raw gaze the swing at a saccade's end (the glissade) exceeds it too,
    /// and prolongs the saccade.
    double acceleration_deg_s2 = 8000.0;
    double motion_deg = 0.1; ///< and the eye has to have moved this far from where it rested
    /// By so much at most the velocity threshold is raised: by the mean speed of the last 40 ms. Keeps
    /// pursuit from being taken for saccades, and glissades from prolonging them. 0: it stays as it is.
    double pursuit_deg_s = 60.0;
    double onset_verify_ms = 4.0;   ///< for so long the eye has to be fast
    double offset_verify_ms = 20.0; ///< for so long the eye has to be slow
    double blink_verify_ms = 12.0;  ///< for so long the pupil has to be there
    bool operator==(const EventSettings&) const = default;
};

// Constants of the method: windows long enough to average the noise of a sample away and short against a
// saccade.
/// Velocity is the slope over this time to each side: an EyeLink's filter spans 4 ms (peak velocities of its
/// own files agree with 4 to 6 ms within 2 to 8 %).
inline constexpr double velocity_window_ms = 5.0;
/// Acceleration is the curvature over this time to each side: it takes a longer window for the same noise.
inline constexpr double acceleration_window_ms = 8.0;
/// Over which the speed is averaged that raises the threshold (manual, section 4.3.6).
inline constexpr double pursuit_window_ms = 40.0;
/// Nothing is said across a longer time without samples: what is open ends before it.
inline constexpr double longest_gap_ms = 50.0;

/// Counts up with each change of the method that changes events.
inline constexpr int event_detector_version = 1;
inline constexpr std::string_view event_detector_name = "overt";

/// Who told a recording's fixations, saccades and blinks, and how.
struct EventDetection {
    std::string name; ///< of the detector
    int version = 0;
    std::string parameters; ///< a JSON object
    bool operator==(const EventDetection&) const = default;
};

/// The settings and constants as a JSON object, the same text for the same settings: for the record.
std::string json_of(const EventSettings& settings);

/// What is put on record of a detection with these settings.
EventDetection detection_by(const EventSettings& settings);

} // namespace overt
