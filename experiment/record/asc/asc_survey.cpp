#include "experiment/record/asc/asc_survey.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/base/utf8_text.h"
#include "experiment/record/asc/asc_pair_check.h"
#include "experiment/record/asc/asc_survey_checks.h"
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
            survey_.places_off_screen += is_off(sample.gaze->x_px) || is_off(sample.gaze->y_px);
            ++survey_.places;
        }
        (sample.eye == Eye::left ? survey_.has_left : survey_.has_right) = true;
        ++survey_.samples;
        survey_.samples_without_gaze += !sample.gaze;
    }
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
        throw InputError(fmt::format(
            "{}: no recording of an EyeLink was found in {} lines, {} of them could not "
            "be read. Give a file that edf2asc has written; tables of other trackers are imported with "
            "--protocol, which says what was shown.",
            file, survey.lines, survey.skipped_lines));
    if (!survey.format.is_eyelinks && !survey.format.eyes_are_known && survey.events == 0)
        throw InputError(fmt::format(
            "{}: is a table of numbers, and nothing in it is as an EyeLink has it: no header, no message, "
            "no event, no status after the values of a sample. Give a file that edf2asc has written; tables "
            "of "
            "other trackers are imported with --protocol, which says what was shown.",
            file));
    check_gaze(survey, file, options);
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
