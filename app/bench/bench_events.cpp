#include <algorithm>
#include <cstdio>
#include <ctime>

#include <fmt/format.h>

#include "app/bench/bench_command.h"
#include "app/bench/reference_gaze.h"
#include "experiment/base/error.h"
#include "experiment/events/event_agreement.h"
#include "experiment/events/event_detector.h"
#include "experiment/events/planted_gaze.h"

namespace fs = std::filesystem;

namespace overt {

namespace {

using Kind = GazeEvent::Kind;

class Counter final : public EventListener {
  public:
    void detected(const GazeEvent&) override { ++events; }
    int events = 0;
};

/// The detector against one reference, or several together.
struct Agreement {
    EventAgreement fixations{Kind::fixation}, saccades{Kind::saccade};
    SampleAgreement in_fixation, in_saccade;

    /// Without saccades that hold a blink, for people call the movement of the lid a part of the blink.
    bool lids_are_no_saccades = false;

    void add(const ReferenceRecording& recording) {
        std::vector<GazeEvent> events = recording.found;
        if (lids_are_no_saccades)
            forget_lids(events);
        fixations.add(recording.events, events);
        saccades.add(recording.events, events);
        for (const auto& [kind, agreement] :
             {std::pair(Kind::fixation, &in_fixation), std::pair(Kind::saccade, &in_saccade)}) {
            const std::vector<bool> theirs = samples_within(recording.samples, recording.events, kind),
                                    ours = samples_within(recording.samples, events, kind);
            for (std::size_t i = 0; i < theirs.size(); ++i)
                agreement->add(theirs[i], ours[i]);
        }
    }
    static void forget_lids(std::vector<GazeEvent>& events) {
        std::vector<GazeEvent> blinks;
        std::copy_if(events.begin(), events.end(), std::back_inserter(blinks),
                     [](const GazeEvent& event) { return event.kind == Kind::blink; });
        std::erase_if(events, [&](const GazeEvent& event) {
            return event.kind == Kind::saccade &&
                   std::any_of(blinks.begin(), blinks.end(), [&](const GazeEvent& blink) {
                       return event.start <= blink.start && blink.end <= event.end;
                   });
        });
    }
    void add(const ReferenceGaze& gaze) {
        for (const ReferenceRecording& recording : gaze.recordings)
            add(recording);
    }
};

BenchFigure plain(std::string figure, double value, std::string unit) {
    return {std::move(figure), value, std::move(unit), {}, {}};
}

/// The targets: nothing where none is set.
struct Targets {
    std::optional<double> fixation_f1 = {}, saccade_f1 = {}, saccade_kappa = {}, onset_ms = {},
                          offset_ms = {};
};

void add_figures(BenchFigures& figures, const std::string& name, const Agreement& agreement,
                 const Targets& targets) {
    const auto add = [&](std::string what, double value, const std::string& unit,
                         std::optional<double> target, bool is_least) {
        what = name + ": " + what;
        figures.push_back(!target    ? plain(what, value, unit)
                          : is_least ? at_least(what, value, unit, *target)
                                     : at_most(what, value, unit, *target));
    };
    add("fixation F1", agreement.fixations.f1(), "", targets.fixation_f1, true);
    add("saccade F1", agreement.saccades.f1(), "", targets.saccade_f1, true);
    add("fixation kappa of samples", agreement.in_fixation.kappa(), "", {}, true);
    add("saccade kappa of samples", agreement.in_saccade.kappa(), "", targets.saccade_kappa, true);
    for (const auto& [of, events] :
         {std::pair("fixation", &agreement.fixations), {"saccade", &agreement.saccades}}) {
        // Of no event that both have there is no error.
        if (const auto onset_ms = events->median_onset_error_ms())
            add(fmt::format("{} onset, median error", of), *onset_ms, "ms", targets.onset_ms, false);
        if (const auto offset_ms = events->median_offset_error_ms())
            add(fmt::format("{} offset, median error", of), *offset_ms, "ms", targets.offset_ms, false);
        add(fmt::format("{}s of the reference", of), events->in_reference(), "", {}, true);
        add(fmt::format("{}s found", of), events->detected(), "", {}, true);
    }
}

/// Steady gaze that is hardly ever lost: what a good recording of a willing observer looks like.
bool is_calm(const ReferenceGaze& gaze) {
    constexpr double most_step_deg = 0.03, most_lost_share = 0.01;
    std::vector<double> steps_deg;
    std::size_t lost = 0, samples = 0;
    for (const ReferenceRecording& recording : gaze.recordings) {
        const GazeSample* before = nullptr;
        for (const GazeSample& sample : recording.samples) {
            ++samples;
            lost += !sample.gaze;
            if (before && before->gaze && sample.gaze)
                steps_deg.push_back(recording.angles.angle_deg(*before->gaze, *sample.gaze));
            before = &sample;
        }
    }
    if (steps_deg.empty())
        return false;
    const auto middle = steps_deg.begin() + static_cast<std::ptrdiff_t>(steps_deg.size() / 2);
    std::nth_element(steps_deg.begin(), middle, steps_deg.end());
    return *middle < most_step_deg &&
           static_cast<double>(lost) < most_lost_share * static_cast<double>(samples);
}

// Of samples that lie 4 ms apart, as they do at 250 Hz: two, and one.
constexpr double onset_target_ms = 8.0, offset_target_ms = 4.0;

/// By which thresholds a recording's events were found.
void add_thresholds(BenchFigures& figures, const ReferenceGaze& gaze) {
    figures.push_back(plain(gaze.name + ": velocity threshold", gaze.settings.velocity_deg_s, "deg/s"));
    figures.push_back(
        plain(gaze.name + ": acceleration threshold", gaze.settings.acceleration_deg_s2, "deg/s2"));
}

/// The tracker's own events.
void measure_trackers(BenchFigures& figures, const std::vector<ReferenceGaze>& references) {
    Agreement all, calm;
    int calm_files = 0;
    for (const ReferenceGaze& gaze : references) {
        Agreement one;
        one.add(gaze);
        all.add(gaze);
        add_thresholds(figures, gaze);
        add_figures(figures, gaze.name, one, {});
        if (!is_calm(gaze))
            continue;
        calm.add(gaze);
        ++calm_files;
    }
    if (calm_files > 0)
        add_figures(figures, fmt::format("{} calm recordings", calm_files), calm,
                    {.fixation_f1 = 0.98,
                     .saccade_f1 = 0.95,
                     .onset_ms = onset_target_ms,
                     .offset_ms = offset_target_ms});
    if (!references.empty())
        add_figures(figures, fmt::format("all {} recordings with a tracker's events", references.size()), all,
                    {.fixation_f1 = 0.95, .onset_ms = onset_target_ms, .offset_ms = offset_target_ms});
}

/// Why a person's saccades and the program's are not of the same samples.
class SaccadeDifferences {
  public:
    void add(const ReferenceRecording& recording) {
        std::vector<GazeEvent> found = recording.found;
        Agreement::forget_lids(found);
        const std::vector<bool> theirs = samples_within(recording.samples, recording.events, Kind::saccade),
                                ours = samples_within(recording.samples, found, Kind::saccade);
        for (std::size_t i = 0; i < theirs.size(); ++i) {
            const bool is_swing = recording.labels[i] == swing_label;
            if (!is_swing)
                without_swings_.add(theirs[i], ours[i]);
            ours_alone_ += ours[i] && !theirs[i];
            swings_ += ours[i] && !theirs[i] && is_swing;
        }
        // Of each of their saccades: whether any of it was found.
        for (std::size_t begin = 0, end = 0; begin < theirs.size(); begin = end) {
            bool is_found = false;
            std::size_t missed = 0;
            for (end = begin; end < theirs.size() && theirs[end] == theirs[begin]; ++end) {
                is_found |= ours[end];
                missed += !ours[end];
            }
            if (!theirs[begin])
                continue;
            theirs_alone_ += missed;
            in_missed_ += is_found ? 0 : missed;
        }
    }

    void report(BenchFigures& figures, const std::string& name) const {
        const auto percent = [](std::size_t part, std::size_t all) {
            return 100.0 * static_cast<double>(part) / static_cast<double>(std::max<std::size_t>(all, 1));
        };
        figures.push_back(
            plain(name + ": saccade kappa of samples, without swings", without_swings_.kappa(), ""));
        figures.push_back(plain(name + ": saccade samples of the program alone that are swings",
                                percent(swings_, ours_alone_), "%"));
        figures.push_back(plain(name + ": saccade samples of the person alone in saccades not found",
                                percent(in_missed_, theirs_alone_), "%"));
    }

  private:
    SampleAgreement without_swings_;
    std::size_t ours_alone_ = 0, swings_ = 0, theirs_alone_ = 0, in_missed_ = 0;
};

/// People's labels, by file: the program against each of them, and each two against each other.
void measure_people(BenchFigures& figures, const std::vector<std::vector<ReferenceGaze>>& files) {
    Agreement all, people;
    all.lids_are_no_saccades = true;
    SaccadeDifferences differences;
    int labellings = 0, pairs = 0;
    for (const std::vector<ReferenceGaze>& of_file : files) {
        for (const ReferenceGaze& gaze : of_file) {
            Agreement one;
            one.lids_are_no_saccades = true;
            one.add(gaze);
            all.add(gaze);
            for (const ReferenceRecording& recording : gaze.recordings)
                differences.add(recording);
            ++labellings;
            add_thresholds(figures, gaze);
            add_figures(figures, gaze.name, one, {});
        }
        for (std::size_t a = 0; a < of_file.size(); ++a) {
            for (std::size_t b = a + 1; b < of_file.size(); ++b) {
                ReferenceRecording both = of_file[a].recordings.front();
                both.found = of_file[b].recordings.front().events;
                people.add(both);
                ++pairs;
            }
        }
    }
    if (labellings == 0)
        return;
    const std::string name = fmt::format("all {} labellings by people", labellings);
    add_figures(figures, name, all, {.fixation_f1 = 0.93, .saccade_kappa = 0.78});
    differences.report(figures, name);
    if (pairs > 0)
        add_figures(figures, fmt::format("two people against each other, {} recordings", pairs), people, {});
}

/// Planted events, by the rate of the tracker: 60 Hz is three samples or fewer in a saccade.
void measure_planted(BenchFigures& figures, const ChosenThresholds& thresholds) {
    struct Trace {
        double rate_hz, noise_deg, fixation_f1, saccade_f1;
    };
    constexpr Trace traces[] = {{60.0, 0.05, 0.93, 0.7},    {120.0, 0.05, 0.98, 0.95},
                                {250.0, 0.02, 0.99, 0.97},  {500.0, 0.02, 0.99, 0.98},
                                {1000.0, 0.02, 0.99, 0.99}, {2000.0, 0.02, 0.99, 0.99}};
    const ScreenGeometry screen;
    for (const Trace& trace : traces) {
        PlantedGaze planted =
            plant_gaze({.rate_hz = trace.rate_hz, .duration_s = 120.0, .noise_deg = trace.noise_deg}, screen);
        Agreement agreement;
        const ReferenceGaze gaze = reference_gaze(
            fmt::format("planted events, {} Hz, noise {} deg", trace.rate_hz, trace.noise_deg),
            GazeAngles(screen), std::move(planted.samples), std::move(planted.events), thresholds);
        agreement.add(gaze);
        add_thresholds(figures, gaze);
        add_figures(figures, gaze.name, agreement,
                    {.fixation_f1 = trace.fixation_f1, .saccade_f1 = trace.saccade_f1});
    }
}

void measure_speed(BenchFigures& figures) {
    const ScreenGeometry screen;
    constexpr double rate_hz = 2000.0;
    const PlantedGaze planted = plant_gaze({.rate_hz = rate_hz, .duration_s = 120.0}, screen);
    Counter counter;
    EventDetector detector({}, GazeAngles(screen), counter);
    // Time of the processor: what else runs on this machine does not count.
    const std::clock_t start = std::clock();
    for (const GazeSample& sample : planted.samples)
        detector.push(sample);
    detector.finish();
    const double taken_s = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    const double per_second = static_cast<double>(planted.samples.size()) / taken_s;
    figures.push_back(plain("samples at 2000 Hz looked at", per_second, "1/s"));
    figures.push_back(
        at_most("share of a core at 2000 samples a second", 100.0 * rate_hz / per_second, "%", 1.0));
}

/// The files named, and those in the folders named; of folders only what can be compared with.
std::vector<fs::path> files_of(const std::vector<fs::path>& given) {
    std::vector<fs::path> files;
    for (const fs::path& path : given) {
        if (!fs::exists(path))
            throw InputError(fmt::format("{}: there is no such file or folder.", path.string()));
        if (!fs::is_directory(path)) {
            files.push_back(path);
            continue;
        }
        std::vector<fs::path> found;
        for (const fs::directory_entry& entry : fs::recursive_directory_iterator(path))
            if (entry.is_regular_file() &&
                (entry.path().extension() == ".asc" || is_labelled_table(entry.path())))
                found.push_back(entry.path());
        if (found.empty())
            throw InputError(
                fmt::format("{}: holds no recordings with events: EyeLink .asc files, or tables of labelled "
                            "samples.",
                            path.string()));
        std::sort(found.begin(), found.end());
        files.insert(files.end(), found.begin(), found.end());
    }
    return files;
}

} // namespace

BenchFigures bench_events(const BenchOptions& options) {
    BenchFigures figures;
    if (options.files.empty()) {
        measure_planted(figures, options.thresholds);
        measure_speed(figures);
        return figures;
    }
    std::vector<ReferenceGaze> of_trackers;
    std::vector<std::vector<ReferenceGaze>> of_people;
    for (const fs::path& file : files_of(options.files)) {
        try {
            if (file.extension() == ".asc") {
                of_trackers.push_back(read_asc_reference(file, options.thresholds));
            } else {
                of_people.push_back(read_labelled_reference(file, options.thresholds));
            }
        } catch (const InputError& reason) {
            // One of many that cannot be compared is no reason to compare none.
            if (options.files.size() == 1 && !fs::is_directory(options.files.front()))
                throw;
            fmt::print(stderr, "left out: {}\n", reason.what());
        }
    }
    measure_trackers(figures, of_trackers);
    measure_people(figures, of_people);
    if (figures.empty())
        throw InputError("None of the recordings can be compared with.");
    measure_speed(figures);
    return figures;
}

} // namespace overt
