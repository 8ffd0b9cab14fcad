/// What an eye tracker said besides samples, kept as it said it: its own fixations, saccades and blinks, and
/// the messages in its file.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "experiment/gaze.h"

namespace overt {

struct GazeEvent {
    enum class Kind : std::uint8_t {
        fixation,
        saccade,
        blink,
        message, ///< sent to the tracker, or by it
        button,  ///< of its button box: number and state in the text
        input,   ///< of its input port: value in the text
        started, ///< recording; in the text the eyes, and what its layout says of the tracking
        ended,   ///< recording; px per degree in the text, as the tracker has them
        note,    ///< a line without a time, such as the table of a calibration
    };
    Kind kind = Kind::message;
    std::optional<Eye> eye;             ///< of fixations, saccades and blinks
    TrackerTime start;                  ///< of a note: of the line before it
    TrackerTime end;                    ///< of the last sample in it; of what has no duration the start
    TrackerClock::duration duration{};  ///< as the tracker gives it
    std::optional<ScreenPoint> place;   ///< mean of a fixation, start of a saccade
    std::optional<ScreenPoint> arrival; ///< end of a saccade
    std::optional<double> pupil;        ///< mean of a fixation
    std::optional<double> amplitude_deg, peak_velocity_deg_s; ///< of a saccade
    std::string text;                                         ///< UTF-8
    bool operator==(const GazeEvent&) const = default;
};
std::string_view name_of(GazeEvent::Kind kind);

/// Whether it is one eye's: a fixation, a saccade or a blink.
bool is_eye_event(GazeEvent::Kind kind);

/// Nothing for a word that is no kind's name.
std::optional<GazeEvent::Kind> gaze_event_kind(std::string_view word);

/// A tracker's file that a sitting's gaze was taken from.
struct GazeSource {
    std::string file;   ///< its name, without folders
    std::string sha256; ///< of its bytes
    std::string header; ///< its first lines, that begin with "**"
    bool pupil_is_diameter = false;
    double rate_hz = 0.0;
    bool has_left = false, has_right = false;
    std::optional<double> px_per_deg_x, px_per_deg_y; ///< as the tracker has them
    std::int64_t skipped_lines = 0;                   ///< that could not be read
    bool operator==(const GazeSource&) const = default;
};

} // namespace overt
