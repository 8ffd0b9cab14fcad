#include "experiment/record/asc/asc_survey_checks.h"

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/base/error.h"

namespace overt {
namespace {

double share_off_screen(const AscSurvey& survey) {
    return survey.places > 0
               ? static_cast<double>(survey.places_off_screen) / static_cast<double>(survey.places)
               : 0.0;
}

/// The share of lines that were read of those of one kind.
struct ReadLines {
    std::int64_t read = 0, lines = 0;
    /// A line or two may be broken in a file however short.
    bool is_too_few(double least) const {
        constexpr std::int64_t few_lost = 2;
        return lines - read > few_lost && static_cast<double>(read) < least * static_cast<double>(lines);
    }
};

} // namespace

void check_gaze(const AscSurvey& survey, const std::string& file, const AscSurveyOptions& options) {
    const bool takes_events_alone = options.least_read <= 0.0;
    if (2 * survey.raw_samples > survey.samples && !takes_events_alone)
        throw InputError(fmt::format(
            "{}: {} of {} samples have pupils of less than 0, EyeLink's sign of raw data (the tracker's "
            "setting file_sample_raw_pcr): places of the pupil and of its corneal reflection in the "
            "camera's picture, and no gaze. Record with that setting off; to import events and messages "
            "all the same, give --least-read 0.",
            file, survey.raw_samples, survey.samples));
    if (survey.samples == 0 && survey.samples_that_are_no_gaze > 0 && !takes_events_alone)
        throw InputError(fmt::format(
            "{}: its samples are raw places of the pupil, or in the head's frame (SAMPLES PUPIL or HREF), "
            "and no places on a screen. Convert the recording again with gaze: edf2asc -sg; to import "
            "events and messages all the same, give --least-read 0.",
            file));
    if (!survey.format.kind_is_declared && !options.is_gaze && share_off_screen(survey) > 0.5)
        throw InputError(fmt::format(
            "{}: nothing says of what its samples are, and {:.0f} % of them lie off the screen: they seem "
            "to be raw places of the pupil, or in the head's frame (edf2asc -sp or -sh), and no gaze. "
            "Convert the recording again with gaze and with events: edf2asc -sg. If they are gaze, give "
            "--as-gaze.",
            file, 100.0 * share_off_screen(survey)));
}

void check_shares(const AscSurvey& survey, const std::string& file, double least) {
    constexpr std::int64_t few_lines = 20;
    AscReadShare all;
    std::vector<std::string> faults;
    const auto check = [&](const AscReadShare& share, std::string_view of, std::int64_t fewest) {
        const ReadLines samples{share.samples_read, share.sample_lines},
            events{share.events_read, share.event_lines};
        if (samples.lines >= fewest && samples.is_too_few(least))
            faults.push_back(fmt::format("{} of {} lines of samples{}", samples.read, samples.lines, of));
        if (events.lines >= fewest && events.is_too_few(least))
            faults.push_back(fmt::format("{} of {} lines of fixations, saccades and blinks{}", events.read,
                                         events.lines, of));
    };
    for (const AscReadShare& share : survey.recordings) {
        all.sample_lines += share.sample_lines;
        all.samples_read += share.samples_read;
        all.event_lines += share.event_lines;
        all.events_read += share.events_read;
    }
    check(all, "", 1);
    if (faults.empty())
        for (const AscReadShare& share : survey.recordings)
            check(share,
                  share.start ? fmt::format(" of the recording that began at {} ms",
                                            share.start->time_since_epoch().count() / 1000)
                              : std::string(" before the first START"),
                  few_lines);
    if (faults.empty())
        return;
    constexpr std::size_t shown = 5;
    const std::size_t more = faults.size() - std::min(faults.size(), shown);
    faults.resize(std::min(faults.size(), shown));
    throw InputError(fmt::format(
        "{}: only {}{} could be imported. {}To import what is there all the same, give --least-read 0.", file,
        fmt::join(faults, ", and "), more > 0 ? fmt::format(", and {} more", more) : "",
        survey.samples_that_are_no_gaze > 0
            ? fmt::format("{} samples are no gaze on a screen (SAMPLES HREF or PUPIL). ",
                          survey.samples_that_are_no_gaze)
            : std::string()));
}

} // namespace overt
