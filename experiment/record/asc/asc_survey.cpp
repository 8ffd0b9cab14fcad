#include "experiment/record/asc/asc_survey.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/base/error.h"
#include "experiment/base/utf8_text.h"
#include "experiment/record/asc/asc_pair_check.h"
#include "experiment/record/asc/asc_words.h"

namespace overt {
namespace {

using Kind = GazeEvent::Kind;

/// The numbers after a message's first word, up to four.
std::vector<double> numbers_of(std::string_view text) {
    Words words(text);
    std::vector<double> numbers;
    for (std::string_view word = words.next(); !word.empty() && numbers.size() < 4; word = words.next())
        if (const std::optional<double> number = number_of(word))
            numbers.push_back(*number);
    return numbers;
}

bool is_trial_result(const GazeEvent& event) {
    return event.kind == Kind::message && Words(event.text).next() == "TRIAL_RESULT";
}

class Surveyor final : public AscListener {
  public:
    Surveyor(AscSurvey& survey, const AscFiles& files, const AscReport& report)
        : survey_(survey), files_(files), report_(report) {}

    void header(std::string_view line) override {
        constexpr std::size_t longest_header = 65536;
        if (survey_.header.size() + line.size() < longest_header)
            survey_.header += fmt::format("{}{}", survey_.header.empty() ? "" : "\n", ascii_of(line));
    }
    void samples(std::span<const GazeSample> samples) override;
    void event(const GazeEvent& event) override;
    void malformed(std::int64_t line, std::string_view why, std::string_view text) override;

    bool has_trial_ids() const { return has_trial_ids_; }
    int trials(AscTrialCutter::By by) const {
        return 1 + (by == AscTrialCutter::By::trial_ids ? by_ids_ : by_recordings_).trial();
    }
    std::string fault_of_pair() const { return pair_.fault(); }
    double share_off_screen() const;
    std::int64_t shortest_interval_us() const { return shortest_interval_us_; }
    bool clock_began_anew() const { return clock_began_anew_; }
    TrackerTime began_anew_at() const { return began_anew_at_; }

  private:
    void take_time(TrackerTime time);
    void take_message(const GazeEvent& event);

    AscSurvey& survey_;
    const AscFiles& files_;
    const AscReport& report_;
    AscTrialCutter by_ids_{AscTrialCutter::By::trial_ids}, by_recordings_{AscTrialCutter::By::recordings};
    bool has_trial_ids_ = false, has_time_ = false, clock_began_anew_ = false;
    TrackerTime began_anew_at_;
    std::optional<TrackerTime> last_sample_;
    std::int64_t shortest_interval_us_ = 0;
    AscPairCheck pair_;
    std::array<std::int64_t, 2> off_screen_{}; ///< places: of negative coordinates, and all
};

void Surveyor::take_time(TrackerTime time) {
    survey_.first = has_time_ ? std::min(survey_.first, time) : time;
    survey_.last = has_time_ ? std::max(survey_.last, time) : time;
    has_time_ = true;
}

void Surveyor::samples(std::span<const GazeSample> samples) {
    const TrackerTime time = samples.front().sampled_at;
    take_time(time);
    if (by_ids_.take_sample())
        survey_.trial_numbers.emplace_back();
    by_recordings_.take_sample();
    if (last_sample_ && time < *last_sample_ && !clock_began_anew_) {
        clock_began_anew_ = true;
        began_anew_at_ = time;
    }
    if (last_sample_ && time > *last_sample_) {
        const std::int64_t interval_us = (time - *last_sample_).count();
        shortest_interval_us_ =
            shortest_interval_us_ == 0 ? interval_us : std::min(shortest_interval_us_, interval_us);
    }
    last_sample_ = time;
    if (files_.are_two())
        pair_.samples(samples);
    for (const GazeSample& sample : samples) {
        if (sample.gaze) {
            constexpr double largest_screen_px = 8192.0;
            const auto is_off = [&](double px) { return px < 0.0 || px > largest_screen_px; };
            off_screen_[0] += is_off(sample.gaze->x_px) || is_off(sample.gaze->y_px);
            ++off_screen_[1];
        }
        (sample.eye == Eye::left ? survey_.has_left : survey_.has_right) = true;
        ++survey_.samples;
        survey_.samples_without_gaze += !sample.gaze;
    }
}

double Surveyor::share_off_screen() const {
    return off_screen_[1] > 0 ? static_cast<double>(off_screen_[0]) / static_cast<double>(off_screen_[1])
                              : 0.0;
}

void Surveyor::event(const GazeEvent& event) {
    if (by_ids_.take(event))
        survey_.trial_numbers.emplace_back();
    if (is_trial_id(event) && !survey_.trial_numbers.empty())
        survey_.trial_numbers.back() = asc_trial_number(event);
    by_recordings_.take(event);
    if (files_.are_two())
        pair_.event(event);
    ++survey_.events;
    if (event.kind == Kind::note)
        return;
    take_time(event.start);
    take_time(event.end);
    if (event.kind == Kind::message)
        take_message(event);
    if (event.kind == Kind::ended && !survey_.px_per_deg)
        if (const std::vector<double> res = numbers_of(event.text);
            res.size() == 2 && res[0] > 0.0 && res[1] > 0.0)
            survey_.px_per_deg = glm::dvec2(res[0], res[1]);
}

void Surveyor::take_message(const GazeEvent& event) {
    const std::string& text = event.text;
    has_trial_ids_ |= is_trial_id(event);
    if (text.starts_with("DISPLAY_COORDS") || (text.starts_with("GAZE_COORDS") && !survey_.screen_px)) {
        const std::vector<double> edges = numbers_of(text);
        constexpr double largest_px = 32768.0;
        if (edges.size() == 4 && edges[2] > edges[0] && edges[3] > edges[1] &&
            edges[2] - edges[0] < largest_px && edges[3] - edges[1] < largest_px)
            survey_.screen_px =
                glm::ivec2(std::lround(edges[2] - edges[0]) + 1, std::lround(edges[3] - edges[1]) + 1);
    } else if (text.starts_with("SCREEN_PHYS_COORDS")) {
        const std::vector<double> edges = numbers_of(text);
        if (edges.size() == 4 && edges[2] > edges[0] && edges[1] > edges[3] && edges[2] - edges[0] < 1e5 &&
            edges[1] - edges[3] < 1e5)
            survey_.screen_mm = glm::dvec2(edges[2] - edges[0], edges[1] - edges[3]);
    } else if (text.starts_with("SCREEN_DISTANCE")) {
        const std::vector<double> distances = numbers_of(text);
        if (!distances.empty() && distances[0] > 0.0 && distances[0] < 1e5)
            survey_.viewing_distance_mm = distances[0];
    } else if (text.starts_with("FRAMERATE") || text.starts_with("RETRACE_INTERVAL")) {
        const std::vector<double> value = numbers_of(text);
        if (value.empty() || value[0] <= 0.0)
            return;
        const double hz = text.starts_with("FRAMERATE") ? value[0] : 1000.0 / value[0];
        if (hz > 1.0 && hz < 2000.0)
            survey_.refresh_hz = hz;
    }
}

void Surveyor::malformed(std::int64_t line, std::string_view why, std::string_view text) {
    ++survey_.skipped_lines;
    if (report_)
        report_(fmt::format("{}:{}", files_.of_line(text).string(), skipped_line_text(line, why, text)));
}

} // namespace

std::string skipped_line_text(std::int64_t line, std::string_view why, std::string_view text) {
    constexpr std::size_t shown = 120;
    return fmt::format("{}: {}: {}", line, why, ascii_of(text.substr(0, shown)));
}

bool is_trial_id(const GazeEvent& event) {
    return event.kind == Kind::message && event.text.starts_with("TRIALID");
}

std::optional<int> asc_trial_number(const GazeEvent& event) {
    if (!is_trial_id(event))
        return std::nullopt;
    const std::size_t begin = event.text.find_first_of("0123456789");
    if (begin == std::string::npos)
        return std::nullopt;
    int number = 0;
    const auto result =
        std::from_chars(event.text.data() + begin, event.text.data() + event.text.size(), number);
    return result.ec == std::errc() ? std::optional(number) : std::nullopt;
}

bool AscTrialCutter::begin() {
    ++trial_;
    is_over_ = is_after_ = false;
    return true;
}

bool AscTrialCutter::take(const GazeEvent& event) {
    is_after_ |= std::exchange(is_over_, false);
    if (by_ == By::recordings)
        return event.kind == Kind::started && begin();
    if (event.kind == Kind::started && trial_ < 0) {
        began_early_ = true;
        return begin();
    }
    if (!is_trial_id(event)) {
        is_over_ = trial_ >= 0 && is_trial_result(event);
        return false;
    }
    if (began_early_) {
        began_early_ = is_after_ = false;
        return false;
    }
    return begin();
}

bool AscTrialCutter::take_sample() {
    is_after_ |= std::exchange(is_over_, false);
    if (trial_ >= 0)
        return false;
    began_early_ = by_ == By::trial_ids;
    return begin();
}

namespace {

/// Throws InputError if the samples are no gaze.
void check_gaze(const AscSurvey& survey, const Surveyor& surveyor, const std::string& file,
                const AscSurveyOptions& options) {
    const bool takes_events_alone = options.least_read <= 0.0;
    if (2 * survey.raw_samples > survey.samples && !takes_events_alone)
        throw InputError(fmt::format(
            "{}: {} of {} samples have pupils of less than 0, EyeLink's sign of raw data (the tracker's "
            "setting "
            "file_sample_raw_pcr): places of the pupil and of its corneal reflection in the camera's "
            "picture, and "
            "no gaze. Record with that setting off; to import events and messages all the same, give "
            "--least-read 0.",
            file, survey.raw_samples, survey.samples));
    if (survey.samples == 0 && survey.samples_that_are_no_gaze > 0 && !takes_events_alone)
        throw InputError(fmt::format(
            "{}: its samples are raw places of the pupil, or in the head's frame (SAMPLES PUPIL or HREF), "
            "and no "
            "places on a screen. Convert the recording again with gaze: edf2asc -sg; to import events and "
            "messages all the same, give --least-read 0.",
            file));
    if (!survey.format.kind_is_declared && !options.is_gaze && surveyor.share_off_screen() > 0.5)
        throw InputError(fmt::format(
            "{}: nothing says of what its samples are, and {:.0f} % of them lie off the screen: they seem to "
            "be "
            "raw places of the pupil, or in the head's frame (edf2asc -sp or -sh), and no gaze. Convert the "
            "recording again with gaze and with events: edf2asc -sg. If they are gaze, give --as-gaze.",
            file, 100.0 * surveyor.share_off_screen()));
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

/// All recordings together must be read, and each that has more than a few lines.
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

} // namespace

AscSurvey survey_asc(const AscFiles& files, const AscSurveyOptions& options) {
    AscSurvey survey;
    const std::string file = files.path();
    survey.conventions = find_conventions(files, options.missing, part_of(options.progress, 0, 1, 2));
    Surveyor surveyor(survey, files, options.report);
    AscParser parser(surveyor, survey.conventions);
    files.parse(parser, part_of(options.progress, 1, 1, 2));
    survey.format = parser.format();
    survey.recordings = parser.recordings();
    static_cast<AscCounts&>(survey) = parser.counts();
    survey.cut_by = surveyor.has_trial_ids() ? AscTrialCutter::By::trial_ids : AscTrialCutter::By::recordings;
    survey.trials = surveyor.trials(survey.cut_by);
    survey.rate_hz = survey.format.highest_rate_hz;
    if (survey.samples == 0) {
        survey.has_left = survey.format.has_left;
        survey.has_right = survey.format.has_right || !survey.has_left;
    }
    if (survey.rate_hz <= 0.0)
        survey.rate_hz = survey.conventions.stamps_are_rounded && survey.conventions.rate_hz > 0.0
                             ? survey.conventions.rate_hz
                         : surveyor.shortest_interval_us() > 0
                             ? 1e6 / static_cast<double>(surveyor.shortest_interval_us())
                             : 0.0;
    if (survey.trials == 0 && survey.samples_that_are_no_gaze == 0)
        throw InputError(
            fmt::format("{}: no recording of an EyeLink was found in {} lines, {} of them could not "
                        "be read. Give a file that edf2asc has written.",
                        file, survey.lines, survey.skipped_lines));
    if (!survey.format.is_eyelinks && !survey.format.eyes_are_known && survey.events == 0)
        throw InputError(fmt::format(
            "{}: is a table of numbers, and nothing in it is as an EyeLink has it: no header, no message, "
            "no event, no status after the values of a sample. Give a file that edf2asc has written.",
            file));
    check_gaze(survey, surveyor, file, options);
    if (surveyor.clock_began_anew())
        throw InputError(
            fmt::format("{}: the tracker's clock began anew at time stamp {}: this is two recordings "
                        "in one file. Cut it there and import both.",
                        file, surveyor.began_anew_at().time_since_epoch().count() / 1000));
    if (const std::string fault = files.are_two() ? surveyor.fault_of_pair() : ""; !fault.empty())
        throw InputError(fmt::format(
            "{}: {}. They are not of one recording: give the samples and the events of the same one.", file,
            fault));
    check_shares(survey, file, options.least_read);
    return survey;
}

ByteProgress part_of(const ByteProgress& progress, int before, int readings, int all) {
    if (!progress)
        return {};
    return [progress, before, readings, all](std::int64_t done, std::int64_t bytes) {
        const std::int64_t once = bytes / readings;
        progress(done + before * once, all * once);
    };
}

} // namespace overt
