#include "app/bench/reference_gaze.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <optional>

#include <fmt/format.h>

#include "app/cli/this_program.h"
#include "experiment/base/error.h"
#include "experiment/base/scratch_folder.h"
#include "experiment/events/recording_events.h"
#include "experiment/record/asc/asc_import.h"
#include "experiment/record/asc/asc_words.h"
#include "experiment/record/read/session_record.h"

namespace overt {
namespace {

using Kind = GazeEvent::Kind;

class FoundList final : public EventListener {
  public:
    void detected(const GazeEvent& event) override { events.push_back(event); }
    std::vector<GazeEvent> events;
};

void sort_by_begin(std::vector<GazeEvent>& events) {
    std::stable_sort(events.begin(), events.end(),
                     [](const GazeEvent& a, const GazeEvent& b) { return a.start < b.start; });
}

/// Fixations, saccades and blinks of both eyes.
std::array<std::vector<GazeEvent>, 2> eye_events_of(const SessionRecord& record) {
    std::array<std::vector<GazeEvent>, 2> events;
    const auto take = [&](const GazeEvent& event) {
        if (is_eye_event(event.kind) && event.eye)
            events[static_cast<std::size_t>(*event.eye)].push_back(event);
    };
    for (const TrialRecord& trial : record.trials()) {
        record.read_gaze_events(trial, take);
        record.read_gaze_events_after(trial, take);
    }
    for (std::vector<GazeEvent>& of_eye : events)
        sort_by_begin(of_eye);
    return events;
}

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

    std::vector<ReferenceGaze> read(const ChosenThresholds& thresholds) {
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
        for (std::size_t i = 0; i < raters.size(); ++i) {
            references.push_back(reference_gaze(fmt::format("{} ({})", file_.filename().string(), raters[i]),
                                                GazeAngles(screen), samples,
                                                events_of_labels(samples, labels[i], interval), thresholds));
            references.back().recordings.front().labels = std::move(labels[i]);
        }
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

ReferenceGaze reference_gaze(std::string name, const GazeAngles& angles, std::vector<GazeSample> samples,
                             std::vector<GazeEvent> events, const ChosenThresholds& thresholds) {
    const ReadGaze read = [&](const TakeGaze& take) { take(samples, true); };
    const EventSettings settings = thresholds_for(read, angles, thresholds).settings;
    FoundList found;
    find_events(read, angles, settings, found);
    sort_by_begin(found.events);
    return {std::move(name),
            {{angles, std::move(samples), std::move(events), std::move(found.events), {}}},
            settings};
}

ReferenceGaze read_asc_reference(const std::filesystem::path& file, const ChosenThresholds& thresholds) {
    const ScratchFolder scratch("overt-bench");
    AscImportOptions options;
    options.place = {scratch.path(), "bench", "1"};
    options.out = scratch.path() / "session";
    options.program = this_build();
    options.now_utc = utc_now();
    const std::filesystem::path session = import_asc(file, options).session;
    SessionRecord record(session);
    const std::array<std::vector<GazeEvent>, 2> events = eye_events_of(record);
    if (events[0].empty() && events[1].empty())
        throw InputError(
            fmt::format("{}: has no events (EFIX, ESACC) of the tracker to compare with.", file.string()));
    record.detect_events(thresholds);
    constexpr int sitting = 1;
    const SessionRecord::EventOrigin origin = record.event_origin(sitting);
    if (origin.from != SessionRecord::EventOrigin::From::reading)
        throw InputError(
            fmt::format("{}: says neither how large the screen is and how far away, nor its pixels per "
                        "degree (RES at the end of a recording): angles are not known.",
                        file.string()));
    const std::array<std::vector<GazeEvent>, 2> found = eye_events_of(record);
    std::array<std::vector<GazeSample>, 2> samples;
    constexpr std::size_t piece = 65536;
    const auto take = [&](std::span<const GazeSample> some) {
        for (const GazeSample& sample : some)
            samples[static_cast<std::size_t>(sample.eye)].push_back(sample);
    };
    for (const TrialRecord& trial : record.trials()) {
        record.read_samples(trial, piece, take);
        record.read_samples_after(trial, piece, take);
    }
    ReferenceGaze gaze{file.filename().string(), {}, origin.settings};
    for (std::size_t eye = 0; eye < samples.size(); ++eye)
        if (!samples[eye].empty())
            gaze.recordings.push_back(
                {*record.gaze_angles(sitting), std::move(samples[eye]), events[eye], found[eye], {}});
    return gaze;
}

bool is_labelled_table(const std::filesystem::path& file) {
    std::ifstream stream(file);
    std::string line;
    return std::getline(stream, line) && line.starts_with(labelled_begin);
}

std::vector<ReferenceGaze> read_labelled_reference(const std::filesystem::path& file,
                                                   const ChosenThresholds& thresholds) {
    if (!is_labelled_table(file))
        throw InputError(
            fmt::format("{}: is no table of labelled samples: its first line begins with \"{}\".",
                        file.string(), labelled_begin));
    return LabelledTable(file).read(thresholds);
}

} // namespace overt
