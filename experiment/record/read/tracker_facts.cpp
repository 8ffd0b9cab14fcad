#include "experiment/record/read/tracker_facts.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <map>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace overt {

namespace {

struct NamedFacts {
    std::string_view name; ///< how the tracker's name begins
    TrackerFacts facts;
};

constexpr NamedFacts known_trackers[] = {
    {"eyelink", {"SR Research", "P-CR", PupilMeasure::area}},
    // Of a recording elsewhere its own lines say how it tracked.
    {"EyeLink (pupil diameters)", {"SR Research", "", PupilMeasure::diameter}},
    {"EyeLink", {"SR Research", "", PupilMeasure::area}},
    {"tobii", {"Tobii", "P-CR", PupilMeasure::diameter_mm}},
    {"Open Gaze", {"Gazepoint", "P-CR", PupilMeasure::diameter_mm}},
    {"Pupil Core", {"Pupil Labs", "pupil alone, by a model of the eye", PupilMeasure::diameter_mm}},
    // Of tables that other programs wrote.
    {"Tobii", {"Tobii", "P-CR", PupilMeasure::diameter_mm}},
    {"Gazepoint", {"Gazepoint", "P-CR", PupilMeasure::diameter_mm}},
    {"SMI", {"SensoMotoric Instruments", "P-CR", PupilMeasure::diameter}},
    {"simulated", {"", "simulated", PupilMeasure::area}},
    {"mouse", {"", "pointer of a mouse", PupilMeasure::none}},
};

} // namespace

TrackerFacts tracker_facts(const TrackerDescription& tracker) {
    std::string_view name = tracker.name;
    constexpr std::string_view before_name = ", by ";
    if (name == "replay")
        if (const std::size_t at = tracker.model.rfind(before_name); at != std::string::npos)
            name = std::string_view(tracker.model).substr(at + before_name.size());
    for (const NamedFacts& known : known_trackers)
        if (name.starts_with(known.name))
            return known.facts;
    return {};
}

TrackerFacts tracker_facts(const SessionRecord& record, int sitting) {
    const std::optional<GazeSource> source = record.gaze_source(sitting);
    if (!source)
        return tracker_facts(record.header().tracker);
    // An export of a session of ours is a recording of that session's tracker.
    const TrackerDescription& tracker = record.header().tracker;
    TrackerFacts facts = record.header().stimuli.empty() && !tracker.name.starts_with("EyeLink")
                             ? tracker_facts(tracker)
                             : tracker_facts(TrackerDescription{.name = "EyeLink"});
    if (source->pupil_is_diameter)
        facts.pupil = PupilMeasure::diameter;
    return facts;
}

PupilWords pupil_words(PupilMeasure pupil) {
    switch (pupil) {
    case PupilMeasure::area:
        return {"pupil_area", "Pupil area", "the tracker's own unit"};
    case PupilMeasure::diameter:
        return {"pupil_diameter", "Pupil diameter", "the tracker's own unit"};
    case PupilMeasure::diameter_mm:
        return {"pupil_diameter", "Pupil diameter", "mm"};
    case PupilMeasure::none:
        return {"pupil_size",
                "1 while there is gaze: there is no pupil, and neither area nor diameter of one", ""};
    case PupilMeasure::unknown:
        break;
    }
    return {"pupil_size", "Pupil size; whether it is an area or a diameter the tracker does not say",
            "the tracker's own unit"};
}

namespace {

/// Goes through the events of an imported file, whose recordings may have pupils of either kind.
class PupilKind {
  public:
    explicit PupilKind(bool is_diameter) : usual_(is_diameter), is_diameter_(is_diameter) {}

    void take(const GazeEvent& event) {
        if (event.kind == GazeEvent::Kind::started)
            is_diameter_ = usual_ || event.text.find("PUPIL DIAMETER") != std::string::npos;
    }
    bool is_diameter() const { return is_diameter_; }

  private:
    bool usual_, is_diameter_;
};

/// Numbers of trials, from 1, by what their pupils are.
using TrialsByMeasure = std::map<PupilMeasure, std::vector<int>>;

TrialsByMeasure trials_by_measure(const SessionRecord& record, std::optional<int> sitting) {
    TrialsByMeasure trials;
    std::map<int, PupilKind> kinds; // by sitting
    for (const TrialRecord& trial : record.trials()) {
        if (sitting && trial.sitting != *sitting)
            continue;
        PupilMeasure measure = tracker_facts(record, trial.sitting).pupil;
        if (const std::optional<GazeSource> source = record.gaze_source(trial.sitting)) {
            const auto [kind, is_new] = kinds.try_emplace(trial.sitting, source->pupil_is_diameter);
            const auto take = [&kind = kind->second](const GazeEvent& event) { kind.take(event); };
            if (is_new)
                record.read_gaze_events_before(take);
            record.read_gaze_events(trial, take);
            if (kind->second.is_diameter())
                measure = PupilMeasure::diameter;
            record.read_gaze_events_after(trial, take);
        }
        trials[measure].push_back(trial.trial.index + 1);
    }
    return trials;
}

} // namespace

PupilWords pupil_words(const SessionRecord& record, std::optional<int> sitting) {
    const TrialsByMeasure trials = trials_by_measure(record, sitting);
    if (trials.empty())
        return pupil_words(tracker_facts(record.header().tracker).pupil);
    if (trials.size() == 1)
        return pupil_words(trials.begin()->first);
    const auto most = std::ranges::max_element(
        trials, {}, [](const TrialsByMeasure::value_type& of) { return of.second.size(); });
    PupilWords words = pupil_words(most->first);
    words.column = "pupil_size";
    for (const auto& [measure, numbers] : trials) {
        if (measure == most->first)
            continue;
        PupilWords other = pupil_words(measure);
        other.meaning.front() =
            static_cast<char>(std::tolower(static_cast<unsigned char>(other.meaning.front())));
        words.meaning += fmt::format("; in {} {} {}", numbers.size() == 1 ? "trial" : "trials",
                                     fmt::join(numbers, ", "), other.meaning);
        if (other.unit != words.unit)
            words.unit = "the tracker's own unit, or mm";
    }
    return words;
}

std::optional<int> calibration_points(std::string_view method) {
    // Programs before told of their own calibration how many targets it used.
    for (const std::string_view word : {" points", " targets"}) {
        const std::size_t end = method.rfind(word);
        if (end == std::string_view::npos)
            continue;
        std::size_t begin = end;
        while (begin > 0 && std::isdigit(static_cast<unsigned char>(method[begin - 1])))
            --begin;
        int points = 0;
        if (std::from_chars(method.data() + begin, method.data() + end, points).ec == std::errc() &&
            points > 0)
            return points;
    }
    return std::nullopt;
}

} // namespace overt
