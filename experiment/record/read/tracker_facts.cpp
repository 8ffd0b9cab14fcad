#include "experiment/record/read/tracker_facts.h"

#include <cctype>
#include <charconv>

namespace overt {

namespace {

struct NamedFacts {
    std::string_view name; ///< how the tracker's name begins
    TrackerFacts facts;
};

constexpr NamedFacts known_trackers[] = {
    {"eyelink", {"SR Research", "P-CR", PupilMeasure::area}},
    // Of a recording elsewhere its own lines say how it tracked.
    {"EyeLink", {"SR Research", "", PupilMeasure::area}},
    {"tobii", {"Tobii", "P-CR", PupilMeasure::diameter_mm}},
    {"Open Gaze", {"Gazepoint", "P-CR", PupilMeasure::diameter_mm}},
    {"Pupil Core", {"Pupil Labs", "pupil alone, by a model of the eye", PupilMeasure::diameter_mm}},
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
