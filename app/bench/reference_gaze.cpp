#include "app/bench/reference_gaze.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <optional>

#include <fmt/format.h>

#include "experiment/base/error.h"
#include "experiment/record/asc/asc_survey.h"
#include "experiment/record/asc/asc_words.h"

namespace overt {
namespace {

using Kind = GazeEvent::Kind;

/// Angles as the file describes its screen; nothing if it does not.
std::optional<GazeAngles> angles_of(const AscSurvey& survey) {
    if (survey.screen_px && survey.screen_mm && survey.viewing_distance_mm &&
        *survey.viewing_distance_mm > 0.0) {
        ScreenGeometry screen;
        screen.screen_px = *survey.screen_px;
        screen.screen_mm = *survey.screen_mm;
        screen.viewing_distance_mm = *survey.viewing_distance_mm;
        return GazeAngles(screen);
    }
    if (survey.px_per_deg && survey.px_per_deg->x > 0.0 && survey.px_per_deg->y > 0.0)
        return GazeAngles(survey.px_per_deg->x, survey.px_per_deg->y);
    return std::nullopt;
}

class ReferenceListener final : public AscListener {
  public:
    ReferenceListener(ReferenceGaze& gaze, const GazeAngles& angles) : gaze_(gaze), angles_(angles) {}

    void header(std::string_view) override {}
    void malformed(std::int64_t, std::string_view, std::string_view) override {}
    void samples(std::span<const GazeSample> samples) override {
        for (const GazeSample& sample : samples)
            of(sample.eye).samples.push_back(sample);
    }
    void event(const GazeEvent& event) override {
        if (is_eye_event(event.kind))
            of(*event.eye).events.push_back(event);
        else if (event.kind == Kind::started || event.kind == Kind::ended)
            end_recording();
    }
    void end_recording() {
        for (ReferenceRecording& recording : eyes_) {
            std::stable_sort(recording.events.begin(), recording.events.end(),
                             [](const GazeEvent& a, const GazeEvent& b) { return a.start < b.start; });
            if (!recording.samples.empty())
                gaze_.recordings.push_back(std::move(recording));
            recording = {angles_, {}, {}};
        }
    }

  private:
    ReferenceRecording& of(Eye eye) { return eyes_[static_cast<std::size_t>(eye)]; }

    ReferenceGaze& gaze_;
    GazeAngles angles_;
    std::array<ReferenceRecording, 2> eyes_{ReferenceRecording{angles_, {}, {}},
                                            ReferenceRecording{angles_, {}, {}}};
};

std::optional<Kind> kind_of_label(int label) {
    switch (label) {
    case 1:
    case 4:
        return Kind::fixation;
    case 2:
        return Kind::saccade;
    case 5:
        return Kind::blink;
    default:
        return std::nullopt;
    }
}

std::vector<GazeEvent> events_of_labels(const std::vector<GazeSample>& samples,
                                        const std::vector<int>& labels, TrackerClock::duration interval) {
    std::vector<GazeEvent> events;
    for (std::size_t begin = 0, end = 0; begin < labels.size(); begin = end) {
        const std::optional<Kind> kind = kind_of_label(labels[begin]);
        for (end = begin; end < labels.size() && kind_of_label(labels[end]) == kind;)
            ++end;
        if (!kind)
            continue;
        GazeEvent event;
        event.kind = *kind;
        event.eye = samples[begin].eye;
        event.start = samples[begin].sampled_at;
        event.end = samples[end - 1].sampled_at;
        event.duration = event.end - event.start + interval;
        events.push_back(event);
    }
    return events;
}

constexpr std::string_view labelled_begin = "# sampFreq=";

class LabelledTable {
  public:
    explicit LabelledTable(const std::filesystem::path& file) : file_(file), lines_(file) {}

    std::vector<ReferenceGaze> read() {
        std::string line;
        next(line);
        const ScreenGeometry screen = screen_of(line);
        const double rate_hz = value(line, "sampFreq");
        next(line);
        Words names(line);
        for (int i = 0; i < 4; ++i)
            names.next();
        std::vector<std::string> raters;
        for (std::string_view name = names.next(); !name.empty(); name = names.next())
            raters.emplace_back(name);
        if (raters.empty())
            fail("names no column of labels after sample, t_ms, x_px and y_px");
        std::vector<GazeSample> samples;
        std::vector<std::vector<int>> labels(raters.size());
        while (next(line))
            if (!line.empty())
                take(line, samples, labels);
        std::vector<ReferenceGaze> references;
        const TrackerClock::duration interval(std::llround(1e6 / rate_hz));
        for (std::size_t i = 0; i < raters.size(); ++i)
            references.push_back(
                {fmt::format("{} ({})", file_.filename().string(), raters[i]),
                 {{GazeAngles(screen), samples, events_of_labels(samples, labels[i], interval)}}});
        return references;
    }

  private:
    bool next(std::string& line) {
        ++line_;
        if (!std::getline(lines_, line))
            return false;
        if (line.ends_with('\r'))
            line.pop_back();
        return true;
    }
    [[noreturn]] void fail(std::string_view why) const {
        throw InputError(fmt::format("{}:{}: {}.", file_.string(), line_, why));
    }
    double value(const std::string& line, std::string_view name) const {
        Words words(line);
        for (std::string_view word = words.next(); !word.empty(); word = words.next())
            if (word.starts_with(name) && word.substr(name.size()).starts_with('='))
                if (const auto number = number_of(word.substr(name.size() + 1)); number && *number > 0.0)
                    return *number;
        fail(fmt::format("the first line does not say {}=, a number more than 0", name));
    }
    ScreenGeometry screen_of(const std::string& line) const {
        ScreenGeometry screen;
        screen.screen_px = {static_cast<int>(value(line, "resX")), static_cast<int>(value(line, "resY"))};
        screen.screen_mm = 1e3 * glm::dvec2(value(line, "screenW_m"), value(line, "screenH_m"));
        screen.viewing_distance_mm = 1e3 * value(line, "viewDist_m");
        return screen;
    }
    void take(const std::string& line, std::vector<GazeSample>& samples,
              std::vector<std::vector<int>>& labels) {
        Words words(line);
        words.next();
        const auto ms = number_of(words.next()), x_px = number_of(words.next()),
                   y_px = number_of(words.next());
        if (!ms || !x_px || !y_px)
            fail("is no sample: sample, t_ms, x_px, y_px and labels are numbers");
        GazeSample sample;
        sample.sampled_at = tracker_time(std::llround(1e3 * *ms));
        if (*x_px != 0.0 || *y_px != 0.0) {
            sample.gaze = ScreenPoint{*x_px, *y_px};
            sample.pupil_area = 1.0f;
        }
        samples.push_back(sample);
        for (std::vector<int>& of_one : labels) {
            const auto label = number_of(words.next());
            if (!label || *label < 0.0 || *label > 6.0)
                fail("has no label from 0 to 6 for each person");
            of_one.push_back(static_cast<int>(*label));
        }
    }

    std::filesystem::path file_;
    std::ifstream lines_;
    int line_ = 0;
};

} // namespace

ReferenceGaze read_asc_reference(const std::filesystem::path& file) {
    const AscSurvey survey = survey_asc(file, {});
    const std::optional<GazeAngles> angles = angles_of(survey);
    if (!angles)
        throw InputError(
            fmt::format("{}: says neither how large the screen is and how far away, nor its pixels per "
                        "degree (RES at the end of a recording): angles are not known.",
                        file.string()));
    ReferenceGaze gaze{file.filename().string(), {}};
    ReferenceListener listener(gaze, *angles);
    AscParser parser(listener, survey.conventions);
    AscFiles(file).parse(parser);
    listener.end_recording();
    std::size_t events = 0;
    for (const ReferenceRecording& recording : gaze.recordings)
        events += recording.events.size();
    if (events == 0)
        throw InputError(
            fmt::format("{}: has no events (EFIX, ESACC) of the tracker to compare with.", file.string()));
    return gaze;
}

bool is_labelled_table(const std::filesystem::path& file) {
    std::ifstream stream(file);
    std::string line;
    return std::getline(stream, line) && line.starts_with(labelled_begin);
}

std::vector<ReferenceGaze> read_labelled_reference(const std::filesystem::path& file) {
    if (!is_labelled_table(file))
        throw InputError(
            fmt::format("{}: is no table of labelled samples: its first line begins with \"{}\".",
                        file.string(), labelled_begin));
    return LabelledTable(file).read();
}

} // namespace overt
