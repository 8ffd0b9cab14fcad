#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "experiment/record/asc/asc_parser.h"
#include "experiment/record/asc/asc_place.h"
#include "experiment/record/asc/asc_words.h"

namespace overt {
namespace {

constexpr double largest_pupil = 1e6;

/// In a recording; trackers that lose an eye go on with samples.
constexpr std::chrono::milliseconds longest_gap(200);

} // namespace

void AscParser::sample_line(std::string_view line) {
    in_calibration_ = false;
    Words words(line);
    const std::optional<std::int64_t> us = asc_time_us(words.next());
    if (us)
        settle_leap(tracker_time(*us));
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
    const std::optional<TrackerTime> time = stamps_.next(*us, format_.rate_hz);
    if (!time)
        return refuse("a sample at this time was there already");

    if (!format_.eyes_are_declared)
        eyes_by_status(line);
    Samples taken;
    taken.eyes = format_.has_left && format_.has_right ? 2 : 1;
    for (int i = 0; i < taken.eyes; ++i) {
        GazeSample& sample = taken.of_eyes[static_cast<std::size_t>(i)];
        sample.sampled_at = *time;
        sample.eye = taken.eyes == 2    ? (i == 0 ? Eye::left : Eye::right)
                     : format_.has_left ? Eye::left
                                        : Eye::right;
        const std::string_view x = words.next(), y = words.next(), pupil_word = words.next();
        const AscPoint place = place_of(x, y);
        const std::optional<double> pupil = is_missing(pupil_word) ? 0.0 : number_of(pupil_word);
        if (!place.is_valid || !pupil || std::abs(*pupil) > largest_pupil)
            return refuse(pupil_word.empty() ? "a sample without all its values"
                                             : "a value that is no number");
        sample.gaze = place.point;
        sample.pupil_area = place.point ? static_cast<float>(std::max(*pupil, 0.0)) : 0.0f;
    }
    if (last_sample_ && *time <= *last_sample_)
        return refuse("earlier than the sample before it");
    if (!format_.has_further_numbers || !format_.is_eyelinks) {
        const std::string_view further = words.next();
        format_.has_further_numbers |= number_of(further).has_value();
        format_.is_eyelinks |= is_status(further);
    }
    if (const std::optional<TrackerTime> earlier = last_sample_ ? last_sample_ : recording_start_;
        earlier && recording_start_ && std::chrono::abs(*time - *earlier) > longest_gap)
        leap_ = Leap{taken, *earlier, before, number_, std::string(line)};
    else
        deliver(taken);
}

/// Where nothing else says so: a status of five letters after two eyes' values is of both.
void AscParser::eyes_by_status(std::string_view line) {
    Words words(line);
    words.next();
    int values = 0;
    std::string_view word = words.next();
    for (; !word.empty() && (number_of(word) || is_missing(word)); word = words.next())
        ++values;
    constexpr int values_of_both = 6;
    constexpr std::size_t status_of_both = 5;
    const bool has_both = values >= values_of_both && is_status(word) && word.size() == status_of_both;
    format_.has_left = format_.has_right = format_.eyes_are_known = has_both;
}

void AscParser::deliver(const Samples& taken) {
    last_sample_ = last_time_ = taken.of_eyes[0].sampled_at;
    if (!format_.is_gaze) {
        ++counts_.samples_that_are_no_gaze;
        return;
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
