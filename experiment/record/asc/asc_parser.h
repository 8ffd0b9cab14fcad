/// The text form of EyeLink recordings (ASC, as edf2asc writes it), line by line.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "experiment/gaze_event.h"
#include "experiment/record/asc/asc_stamps.h"

namespace overt {

/// What the lines so far say of those to come.
struct AscFormat {
    bool has_left = false, has_right = false;
    double rate_hz = 0.0;                               ///< of the lines to come; 0: not known
    double lowest_rate_hz = 0.0, highest_rate_hz = 0.0; ///< of those so far
    bool pupil_is_diameter = false;
    bool is_eyelinks = false; ///< something is as only EyeLink has it: not any table of numbers
    bool is_gaze = true; ///< else samples are of the pupil or the head's frame, and no place on the screen
    bool events_are_gaze = true; ///< the same of the places of fixations and saccades
    bool has_head_target = false;
    bool has_further_numbers = false; ///< in samples, after their pupils: velocity, resolution, input
    bool eyes_are_known = false;      ///< else samples of one eye are taken for the right one's
    bool eyes_are_declared = false;   ///< by START, SAMPLES, EVENTS or RECCFG, not only by samples of both
};

/// What was counted in the lines so far.
struct AscCounts {
    std::int64_t lines = 0;
    std::int64_t mended_durations = 0;  ///< of events, that could not be: taken from their begin and end
    std::int64_t unfinished_events = 0; ///< begins of fixations, saccades and blinks whose ends never came
    std::int64_t samples_that_are_no_gaze = 0;
    /// Fixations and saccades whose places are of the pupil or the head's frame: they are told without.
    std::int64_t events_that_are_no_gaze = 0;
    std::int64_t non_ascii_texts = 0; ///< taken for Latin-1, as they are not UTF-8
};

/// Told by an AscParser. Texts are valid only during the call.
class AscListener {
  public:
    virtual ~AscListener() = default;
    /// A line that begins with "**".
    virtual void header(std::string_view line) = 0;
    /// One eye's, or both eyes' of one instant, the left one first.
    virtual void samples(std::span<const GazeSample> samples) = 0;
    virtual void event(const GazeEvent& event) = 0;
    /// A line that was skipped. `why` begins in lower case, without a full stop.
    virtual void malformed(std::int64_t line, std::string_view why, std::string_view text) = 0;
};

/// Longer than any line that a tracker writes.
inline constexpr std::size_t longest_asc_line = 16384;

/// Takes one line after another. Lines may end with a carriage return; parts that some files lack may be
/// missing: the header, START and END, SAMPLES and EVENTS, the status column. Time stamps may be whole or
/// with a fraction; where whole ones are repeated, as at 2000 Hz, the second is taken to be half a
/// millisecond later. Nothing is thrown, whatever the lines hold.
class AscParser {
  public:
    explicit AscParser(AscListener& listener) : listener_(listener) {}

    void line(std::string_view line) { this->line(line, counts_.lines + 1); }
    /// The same of the line of this number, where others of its file were left out.
    void line(std::string_view line, std::int64_t number);
    /// There are no more lines.
    void end();

    const AscFormat& format() const { return format_; }
    const AscCounts& counts() const { return counts_; }

  private:
    void sample_line(std::string_view line);
    void event_line(std::string_view line);
    void message_line(std::string_view line);
    void eye_event_begin(std::string_view line, GazeEvent::Kind kind);
    void eye_event_end(std::string_view line, GazeEvent::Kind kind);
    void recording_line(std::string_view line, bool begins);
    void port_line(std::string_view line, GazeEvent::Kind kind);
    bool take_rate(double rate_hz);
    void samples_layout(std::string_view line);
    void note(std::string_view line);
    void layout_line(std::string_view word, std::string_view line);
    void tell_start();
    TrackerClock::duration duration_of(std::string_view word, TrackerClock::duration span);
    void eyes_by_status(std::string_view line);
    void bad(std::string_view why, std::string_view line) { listener_.malformed(number_, why, line); }
    /// A sample's line: of one eye or both, the left one first.
    struct Samples {
        std::array<GazeSample, 2> of_eyes;
        int eyes = 1;
    };
    /// A sample far later than the one before it, or far from its recording's begin. Either its stamp is
    /// broken or the recording has a gap: the time of the line after it tells.
    struct Leap {
        Samples samples;
        TrackerTime from; ///< the sample before it, or the recording's begin
        AscStamps stamps_before;
        std::int64_t line = 0;
        std::string text;
    };
    void deliver(const Samples& taken);
    void settle_leap(std::optional<TrackerTime> next);
    std::string utf8(std::string_view text);
    void drop_open_events();

    AscListener& listener_;
    AscFormat format_;
    AscCounts counts_;
    std::int64_t number_ = 0;
    bool in_calibration_ = false;                ///< lines without a time belong to it
    TrackerTime last_time_;                      ///< of any line
    std::optional<TrackerTime> recording_start_; ///< of what goes on; nothing outside of START and END
    std::optional<GazeEvent> start_;             ///< that was not told yet: its layout is still coming
    std::string start_eyes_;                     ///< that it names
    std::optional<TrackerTime> last_sample_;
    AscStamps stamps_;
    std::optional<Leap> leap_;
    std::array<bool, 6> open_events_{};
};

} // namespace overt
