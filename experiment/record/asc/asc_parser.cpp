#include "experiment/record/asc/asc_parser.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "experiment/base/utf8_text.h"
#include "experiment/record/asc/asc_event_values.h"
#include "experiment/record/asc/asc_words.h"

namespace overt {
namespace {

using Kind = GazeEvent::Kind;

std::optional<Eye> eye_of(std::string_view word) {
    if (word == "L")
        return Eye::left;
    return word == "R" ? std::optional(Eye::right) : std::nullopt;
}

/// What stands after START: how the recording's lines are laid out. The prescalers are those of files of
/// another kind.
constexpr std::array<std::string_view, 6> layout_words{"PRESCALER", "VPRESCALER", "FIXUPDATE",
                                                       "PUPIL",     "EVENTS",     "SAMPLES"};

/// What a layout says of further columns, which are not kept.
bool is_of_further_columns(std::string_view word) {
    constexpr std::array<std::string_view, 7> words{"VEL",     "RES",     "HTARGET", "INPUT",
                                                    "BUTTONS", "HMARKER", "RATE"};
    return std::find(words.begin(), words.end(), word) != words.end();
}

std::size_t slot(Kind kind, Eye eye) {
    return 2 * static_cast<std::size_t>(kind) + (eye == Eye::left ? 0u : 1u);
}

} // namespace

std::string AscParser::utf8(std::string_view text) {
    if (is_utf8(text))
        return std::string(text);
    ++counts_.non_ascii_texts;
    return utf8_of_latin1(text);
}

void AscParser::drop_open_events() {
    counts_.unfinished_events += std::count(open_events_.begin(), open_events_.end(), true);
    open_events_ = {};
}

void AscParser::line(std::string_view line, std::int64_t number) {
    ++counts_.lines;
    number_ = number;
    if (!line.empty() && line.back() == '\r')
        line.remove_suffix(1);
    if (line.size() > longest_asc_line)
        return bad("longer than any line of a recording", line.substr(0, 80));
    if (line.find_first_not_of(" \t") == std::string_view::npos)
        return;
    if (is_comment(line)) {
        ++counts_.comments;
        return;
    }
    const std::string_view word = line.substr(0, line.find_first_of(" \t"));
    if (std::find(layout_words.begin(), layout_words.end(), word) != layout_words.end())
        return layout_line(word, line);
    tell_start();
    if (is_digit(line.front()))
        return sample_line(line);
    if (line.starts_with("**")) {
        format_.is_eyelinks = true;
        return listener_.header(line);
    }
    if (line.starts_with(">>>"))
        return note(line);
    if (is_blank(line.front())) {
        if (in_calibration_)
            return note(line);
        return bad("begins with a blank, and belongs to no calibration", line);
    }
    event_line(line);
}

void AscParser::declare_eyes(bool left, bool right, AscFormat::EyesBy by) {
    if (by < format_.eyes_by)
        return;
    format_.eyes_by = by;
    format_.has_left = left;
    format_.has_right = right;
    format_.eyes_are_known = true;
}

void AscParser::note(std::string_view line) {
    in_calibration_ = true;
    GazeEvent event;
    event.kind = Kind::note;
    event.start = event.end = last_time_;
    event.text = utf8(line);
    listener_.event(event);
}

void AscParser::event_line(std::string_view line) {
    Words words(line);
    const std::string_view word = words.next();
    if (word == "MSG")
        return message_line(line);
    in_calibration_ = false;
    if (word == "SFIX" || word == "SSACC" || word == "SBLINK")
        return eye_event_begin(line, word == "SFIX"    ? Kind::fixation
                                     : word == "SSACC" ? Kind::saccade
                                                       : Kind::blink);
    if (word == "EFIX" || word == "ESACC" || word == "EBLINK")
        return eye_event_end(line, word == "EFIX"    ? Kind::fixation
                                   : word == "ESACC" ? Kind::saccade
                                                     : Kind::blink);
    if (word == "START" || word == "END")
        return recording_line(line, word == "START");
    if (word == "BUTTON" || word == "INPUT")
        return port_line(line, word == "BUTTON" ? Kind::button : Kind::input);
    bad("begins with no known word", line);
}

void AscParser::message_line(std::string_view line) {
    Words words(line);
    words.next();
    const std::optional<std::int64_t> us = asc_time_us(words.next());
    if (!us)
        return bad("a message without a time", line);
    GazeEvent event;
    settle_leap(tracker_time(*us));
    event.start = event.end = last_time_ = tracker_time(*us);
    event.text = utf8(words.rest());
    in_calibration_ = event.text.starts_with("!CAL");
    if (event.text.starts_with("RECCFG")) {
        Words setup(event.text);
        setup.next(), setup.next();
        const std::optional<double> rate_hz = number_of(setup.next());
        setup.next(), setup.next();
        const std::string_view eyes = setup.next();
        if (rate_hz)
            take_rate(*rate_hz);
        if (eyes == "L" || eyes == "R" || eyes == "LR")
            declare_eyes(eyes != "R", eyes != "L", AscFormat::EyesBy::setup);
    }
    listener_.event(event);
}

void AscParser::eye_event_begin(std::string_view line, Kind kind) {
    Words words(line);
    words.next();
    const std::optional<Eye> eye = eye_of(words.next());
    if (!eye || !asc_time_us(words.next()))
        return bad("the begin of an event without eye or time", line);
    bool& is_open = open_events_[slot(kind, *eye)];
    counts_.unfinished_events += is_open;
    is_open = true;
}

void AscParser::eye_event_end(std::string_view line, Kind kind) {
    ++recordings_.back().event_lines;
    Words words(line);
    words.next();
    const std::optional<Eye> eye = eye_of(words.next());
    const std::optional<std::int64_t> start = asc_time_us(words.next()), end = asc_time_us(words.next());
    const std::string_view duration = words.next();
    if (eye)
        open_events_[slot(kind, *eye)] = false; // it ended, whatever becomes of its line
    if (!eye || !start || !end || duration.empty() || *end < *start)
        return bad("an event without eye, begin, end or duration", line);
    GazeEvent event;
    event.kind = kind;
    event.eye = eye;
    event.start = tracker_time(*start);
    event.end = tracker_time(*end);
    event.duration = duration_of(duration, event.end - event.start);
    const AscEventValues values =
        read_event_values(words.rest(), format_.events_are_gaze, conventions_, event);
    if (!values.is_whole)
        return bad("an event without all its values", line);
    counts_.events_that_are_no_gaze += !values.is_gaze;
    counts_.unreadable_event_values += values.unreadable;
    ++recordings_.back().events_read;
    listener_.event(event);
}

/// The tracker's counter overflows in some files: a duration is not longer than from begin to end by more
/// than a sample, nor is it negative. What cannot be is taken from begin and end, the last sample with them.
TrackerClock::duration AscParser::duration_of(std::string_view word, TrackerClock::duration span) {
    constexpr std::chrono::milliseconds most_beyond(100);
    const std::optional<std::int64_t> us = asc_time_us(word);
    if (us && TrackerClock::duration(*us) <= span + most_beyond)
        return TrackerClock::duration(*us);
    ++counts_.mended_durations;
    const double interval_us = format_.rate_hz > 0.0 ? 1e6 / format_.rate_hz : 0.0;
    return span + TrackerClock::duration(static_cast<std::int64_t>(interval_us));
}

void AscParser::tell_start() {
    if (start_)
        listener_.event(*std::exchange(start_, std::nullopt));
}

void AscParser::recording_line(std::string_view line, bool begins) {
    Words words(line);
    words.next();
    const std::optional<std::int64_t> us = asc_time_us(words.next());
    if (!us)
        return bad("the begin or end of a recording without a time", line);
    drop_open_events();
    GazeEvent event;
    settle_leap(tracker_time(*us));
    event.kind = begins ? Kind::started : Kind::ended;
    event.start = event.end = last_time_ = tracker_time(*us);
    // What was declared of the recording before holds until the next says something else.
    format_.eyes_by = std::min(format_.eyes_by, AscFormat::EyesBy::setup);
    bool left = false, right = false;
    for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
        left |= word == "LEFT";
        right |= word == "RIGHT";
        if (word == "RES") {
            const std::string_view x = words.next(), y = words.next();
            event.text = fmt::format("{} {}", number_of(x) ? x : ".", number_of(y) ? y : ".");
        }
    }
    if (begins) {
        if (left || right)
            declare_eyes(left, right, AscFormat::EyesBy::start);
        recordings_.push_back({event.start});
        event.text = left && right ? "LEFT RIGHT" : left ? "LEFT" : right ? "RIGHT" : "";
        start_eyes_ = event.text;
        // A new recording may begin with the time of the last one's end.
        last_sample_.reset();
        stamps_.begin(event.start);
    }
    recording_start_ = begins ? std::optional(event.start) : std::nullopt;
    if (begins)
        start_ = std::move(event);
    else
        listener_.event(event);
}

/// In the event of the recording's START, for it may be another than that of the other recordings.
void AscParser::tell_pupil() {
    constexpr std::string_view words = " PUPIL DIAMETER";
    if (start_ && format_.pupil_is_diameter && !start_->text.ends_with(words))
        start_->text += words;
}

void AscParser::layout_line(std::string_view word, std::string_view line) {
    in_calibration_ = false;
    Words words(line);
    words.next();
    if (word == "SAMPLES" || word == "EVENTS") {
        samples_layout(line);
    } else if (word == "PUPIL") {
        format_.pupil_is_diameter = words.next() == "DIAMETER";
        (format_.pupil_is_diameter ? format_.has_pupil_diameters : format_.has_pupil_areas) = true;
        tell_pupil();
    }
}

void AscParser::port_line(std::string_view line, Kind kind) {
    Words words(line);
    words.next();
    const std::optional<std::int64_t> us = asc_time_us(words.next());
    if (!us)
        return bad("a button or input without a time", line);
    GazeEvent event;
    settle_leap(tracker_time(*us));
    event.kind = kind;
    event.start = event.end = last_time_ = tracker_time(*us);
    for (std::string_view word = words.next(); !word.empty(); word = words.next())
        event.text += fmt::format("{}{}", event.text.empty() ? "" : " ", utf8(word));
    listener_.event(event);
}

bool AscParser::take_rate(double rate_hz) {
    if (!(rate_hz >= 1.0 && rate_hz <= 100'000.0))
        return false;
    format_.rate_hz = rate_hz;
    format_.highest_rate_hz = std::max(format_.highest_rate_hz, rate_hz);
    format_.lowest_rate_hz =
        format_.lowest_rate_hz > 0.0 ? std::min(format_.lowest_rate_hz, rate_hz) : rate_hz;
    return true;
}

void AscParser::samples_layout(std::string_view line) {
    Words words(line);
    const bool is_of_samples = words.next() == "SAMPLES";
    const std::string_view what = words.next();
    if (is_of_samples)
        format_.is_gaze = what == "GAZE", format_.kind_is_declared = true;
    else
        format_.events_are_gaze = what == "GAZE";
    bool left = false, right = false;
    std::string further;
    for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
        const bool is_eye = word == "LEFT" || word == "RIGHT";
        left |= word == "LEFT";
        right |= word == "RIGHT";
        format_.has_head_target |= is_of_samples && word == "HTARGET";
        if (!is_eye && !is_of_further_columns(word))
            further += fmt::format(" {}", ascii_of(word));
        if (word != "RATE")
            continue;
        const std::optional<double> rate_hz = number_of(words.next());
        if (!rate_hz || !take_rate(*rate_hz))
            bad("a sampling rate that is none", line);
    }
    if (start_) // SAMPLES comes last
        start_->text = start_eyes_ + further;
    tell_pupil();
    if (left || right)
        declare_eyes(left, right, is_of_samples ? AscFormat::EyesBy::samples : AscFormat::EyesBy::events);
}

void AscParser::end() {
    tell_start();
    settle_leap(std::nullopt);
    drop_open_events();
}

} // namespace overt
