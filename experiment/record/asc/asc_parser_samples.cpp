#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

#include "experiment/record/asc/asc_parser.h"
#include "experiment/record/asc/asc_words.h"

namespace overt {
namespace {

constexpr int values_of_eye = 3; ///< place and pupil
constexpr std::size_t status_of_one = 3, status_of_both = 5;

/// In a recording; trackers that lose an eye go on with samples.
constexpr std::chrono::milliseconds longest_gap(200);

} // namespace

void AscParser::sample_line(std::string_view line) {
    in_calibration_ = false;
    const std::optional<std::int64_t> us = asc_time_us(Words(line).next());
    if (us)
        settle_leap(tracker_time(*us));
    ++recordings_.back().sample_lines;
    const AscStamps before = stamps_;
    const auto refuse = [&](std::string_view why) {
        // A broken line stands for a sample of its own where its stamp comes next, and for none where it does
        // not: then it must not part the two of a millisecond.
        constexpr std::chrono::milliseconds next(10);
        if (before.last() && stamps_.last() &&
            (*stamps_.last() < *before.last() || *stamps_.last() > *before.last() + next))
            stamps_ = before;
        bad(why, line);
    };
    if (!us)
        return refuse("no time stamp");
    const double rate_hz =
        format_.rate_hz > 0.0 || !conventions_.stamps_are_rounded ? format_.rate_hz : conventions_.rate_hz;
    const std::optional<TrackerTime> time = stamps_.next(*us, rate_hz);
    if (!time)
        return refuse("a sample at this time was there already");

    AscSampleWords words = split_at_blanks(line);
    Samples taken;
    if (!take_eyes(words, *time, taken)) {
        const bool is_short = words.count < values_of_eye * (format_.has_left && format_.has_right ? 2 : 1);
        // What stands for missing values may have blanks in it, or be nothing at all.
        words = split_at_tabs(line);
        if (!take_eyes(words, *time, taken))
            return refuse(is_short ? "a sample without all its values" : "a value that is no number");
    }
    if (last_sample_ && *time <= *last_sample_)
        return refuse("earlier than the sample before it");
    const std::string_view further = taken.eyes == 2               ? words.further
                                     : words.count > values_of_eye ? words.values[values_of_eye]
                                                                   : "";
    format_.has_further_numbers |= number_of(further).has_value();
    format_.is_eyelinks |= !words.status.empty();
    has_status_ |= !words.status.empty();
    counts_.restored_stamps += time->time_since_epoch().count() != *us && conventions_.stamps_are_rounded;
    counts_.decimal_commas += line.find(',') != std::string_view::npos;
    if (const std::optional<TrackerTime> earlier = last_sample_ ? last_sample_ : recording_start_;
        earlier && recording_start_ && std::chrono::abs(*time - *earlier) > longest_gap)
        leap_ = Leap{taken, *earlier, before, number_, std::string(line)};
    else
        deliver(taken);
}

/// Where nothing else says so: a status of five letters after two eyes' values is of both.
void AscParser::eyes_by_status(const AscSampleWords& words) {
    const bool has_both = words.count >= 2 * values_of_eye && words.status.size() == status_of_both;
    format_.has_left = format_.has_right = format_.eyes_are_known = has_both;
}

/// Of a place that might be either eye's: the one that has an event going on, if the other has none, or else
/// the one that was nearer to it before.
Eye AscParser::eye_of_lone_place(const std::optional<ScreenPoint>& place) const {
    bool is_open[2] = {false, false};
    for (std::size_t i = 0; i < open_events_.size(); ++i)
        is_open[i % 2] |= open_events_[i];
    if (is_open[0] != is_open[1])
        return is_open[0] ? Eye::left : Eye::right;
    const auto distance_px = [&](Eye eye) {
        const std::optional<ScreenPoint>& last = last_places_[static_cast<std::size_t>(eye)];
        return place && last ? std::hypot(place->x_px - last->x_px, place->y_px - last->y_px)
                             : std::numeric_limits<double>::infinity();
    };
    return distance_px(Eye::right) < distance_px(Eye::left) ? Eye::right : Eye::left;
}

/// The samples of a line's eyes; false if a value is wrong or not there.
bool AscParser::take_eyes(const AscSampleWords& words, TrackerTime time, Samples& taken) {
    if (format_.eyes_by == AscFormat::EyesBy::nothing)
        eyes_by_status(words);
    const bool is_of_both = format_.has_left && format_.has_right;
    // A line that was cut off lacks the status that others have.
    const bool ends_as_of_one =
        words.status.size() == status_of_one || (!has_status_ && words.count == values_of_eye);
    const bool is_lone = is_of_both && words.count < 2 * values_of_eye && ends_as_of_one;
    const bool is_double =
        !is_of_both && words.count >= 2 * values_of_eye && words.status.size() == status_of_both;
    taken.eyes = (is_of_both && !is_lone) || is_double ? 2 : 1;
    if (words.count < taken.eyes * values_of_eye)
        return false;
    int raw = 0;
    for (int i = 0; i < taken.eyes; ++i) {
        const auto first = static_cast<std::size_t>(i * values_of_eye);
        const AscEyeValues values =
            eye_values(words.values[first], words.values[first + 1], words.values[first + 2], conventions_);
        if (!values.is_valid)
            return false;
        raw += values.is_raw;
        GazeSample& sample = taken.of_eyes[static_cast<std::size_t>(i)];
        sample.sampled_at = time;
        sample.eye = taken.eyes == 2    ? (i == 0 ? Eye::left : Eye::right)
                     : is_lone          ? eye_of_lone_place(values.gaze)
                     : format_.has_left ? Eye::left
                                        : Eye::right;
        sample.gaze = values.gaze;
        sample.pupil_area = values.pupil;
    }
    taken.raw = raw;
    taken.is_lone = is_lone;
    taken.is_double = is_double;
    return true;
}

void AscParser::deliver(const Samples& taken) {
    last_sample_ = last_time_ = taken.of_eyes[0].sampled_at;
    if (!format_.is_gaze) {
        ++counts_.samples_that_are_no_gaze;
        return;
    }
    ++recordings_.back().samples_read;
    counts_.raw_samples += taken.raw;
    counts_.lines_of_one_eye += taken.is_lone;
    counts_.lines_of_both_eyes += taken.is_double;
    for (int i = 0; i < taken.eyes; ++i) {
        const GazeSample& sample = taken.of_eyes[static_cast<std::size_t>(i)];
        if (sample.gaze)
            last_places_[static_cast<std::size_t>(sample.eye)] = sample.gaze;
    }
    listener_.samples(std::span(taken.of_eyes).first(static_cast<std::size_t>(taken.eyes)));
}

void AscParser::settle_leap(std::optional<TrackerTime> next) {
    if (!leap_)
        return;
    const Leap leap = *std::exchange(leap_, std::nullopt);
    const TrackerTime leapt = leap.samples.of_eyes[0].sampled_at;
    if (next && std::chrono::abs(*next - leapt) < std::chrono::abs(*next - leap.from))
        return deliver(leap.samples);
    stamps_ = leap.stamps_before;
    listener_.malformed(leap.line, "far from the times of the sample before it and of the line after it",
                        leap.text);
}

} // namespace overt
