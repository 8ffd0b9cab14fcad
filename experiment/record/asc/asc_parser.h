/// The text form of EyeLink recordings (ASC, as edf2asc writes it), line by line.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "experiment/gaze_event.h"
#include "experiment/record/asc/asc_conventions.h"
#include "experiment/record/asc/asc_sample_words.h"
#include "experiment/record/asc/asc_stamps.h"

namespace overt {

/// What the lines so far say of those to come.
struct AscFormat {
    bool has_left = false, has_right = false;
    double rate_hz = 0.0;                                      ///< of the lines to come; 0: not known
    double lowest_rate_hz = 0.0, highest_rate_hz = 0.0;        ///< of those so far
    bool pupil_is_diameter = false;                            ///< of the recording that goes on
    bool has_pupil_areas = false, has_pupil_diameters = false; ///< some recording has
    bool is_eyelinks = false; ///< something is as only EyeLink has it: not any table of numbers
    bool is_gaze = true; ///< else samples are of the pupil or the head's frame, and no place on the screen
    bool kind_is_declared = false; ///< by a line SAMPLES
    /// Else the places of fixations and saccades are of the pupil or the head's frame; gaze may follow them.
    bool events_are_gaze = true;
    bool has_head_target = false;
    bool has_further_numbers = false; ///< in samples, after their pupils: velocity, resolution, input
    bool eyes_are_known = false;      ///< else samples of one eye are taken for the right one's
    /// What named the eyes of the lines to come. A later one counts more, whatever comes last in the file: a
    /// file of one eye of two (edf2asc -l, -r) still has the message of both.
    enum class EyesBy : std::uint8_t { nothing, setup, events, start, samples };
    EyesBy eyes_by = EyesBy::nothing;
};

/// What was counted in the lines so far.
struct AscCounts {
    std::int64_t lines = 0;
    std::int64_t mended_durations = 0;  ///< of events, that could not be: taken from their begin and end
    std::int64_t unfinished_events = 0; ///< begins of fixations, saccades and blinks whose ends never came
    std::int64_t samples_that_are_no_gaze = 0;
    std::int64_t raw_samples = 0; ///< of eyes, of the pupil and the corneal reflection: kept without gaze
    std::int64_t lines_of_one_eye = 0;        ///< with samples, where the recording is of both
    std::int64_t lines_of_both_eyes = 0;      ///< the same, where it is of one
    std::int64_t restored_stamps = 0;         ///< rounded in the file, and told by the rate
    std::int64_t decimal_commas = 0;          ///< lines of samples with such
    std::int64_t comments = 0;                ///< lines for people
    std::int64_t unreadable_event_values = 0; ///< of events that are kept without them
    /// Fixations and saccades whose places are of the pupil or the head's frame: they are told without.
    std::int64_t events_that_are_no_gaze = 0;
    std::int64_t non_ascii_texts = 0; ///< taken for Latin-1, as they are not UTF-8
};

/// How much of a recording could be read: what lies between one START and the next, or before the first.
struct AscReadShare {
    std::optional<TrackerTime> start; ///< nothing before the first START
    std::int64_t sample_lines = 0, samples_read = 0;
    std::int64_t event_lines = 0, events_read = 0; ///< ends of fixations, saccades and blinks
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

/// Takes one line after another. What a sample's line says of itself counts more than what was said of it:
/// one eye's values and status in a recording of both are one eye's. Lines may end with a carriage return;
/// parts that some files lack may be missing: the header, START and END, SAMPLES and EVENTS, the status
/// column. Time stamps may be whole or with a fraction; where whole ones are repeated, as at 2000 Hz, the
/// second is taken to be half a millisecond later. Nothing is thrown, whatever the lines hold.
class AscParser {
  public:
    explicit AscParser(AscListener& listener, AscConventions conventions = {})
        : listener_(listener), conventions_(std::move(conventions)),
          stamps_(conventions_.stamps_are_rounded) {}

    void line(std::string_view line) { this->line(line, counts_.lines + 1); }
    /// The same of the line of this number, where others of its file were left out.
    void line(std::string_view line, std::int64_t number);
    /// There are no more lines.
    void end();

    const AscFormat& format() const { return format_; }
    const AscCounts& counts() const { return counts_; }
    /// In the file's order, the lines before the first START first.
    const std::vector<AscReadShare>& recordings() const { return recordings_; }

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
    void tell_pupil();
    TrackerClock::duration duration_of(std::string_view word, TrackerClock::duration span);
    void declare_eyes(bool left, bool right, AscFormat::EyesBy by);
    void bad(std::string_view why, std::string_view line) { listener_.malformed(number_, why, line); }
    /// A sample's line: of one eye or both, the left one first.
    struct Samples {
        std::array<GazeSample, 2> of_eyes;
        int eyes = 1;
        int raw = 0;                             ///< eyes whose values are no gaze: AscEyeValues::is_raw
        bool is_lone = false, is_double = false; ///< of one eye, or both, where the recording is of the other
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
    void eyes_by_status(const AscSampleWords& words);
    bool take_eyes(const AscSampleWords& words, TrackerTime time, Samples& taken);
    Eye eye_of_lone_place(const std::optional<ScreenPoint>& place) const;
    void deliver(const Samples& taken);
    void settle_leap(std::optional<TrackerTime> next);
    std::string utf8(std::string_view text);
    void drop_open_events();

    AscListener& listener_;
    AscConventions conventions_;
    AscFormat format_;
    AscCounts counts_;
    std::vector<AscReadShare> recordings_{1};
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
    std::array<std::optional<ScreenPoint>, 2> last_places_; ///< by eye
    bool has_status_ = false;                               ///< some sample had one
};

} // namespace overt
