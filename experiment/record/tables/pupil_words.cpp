#include "experiment/record/tables/pupil_words.h"

#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/record/read/tracker_facts.h"

namespace overt {
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

PupilWords words_of_pupil(PupilMeasure pupil) {
    switch (pupil) {
    case PupilMeasure::area:
        return {};
    case PupilMeasure::diameter:
        return {"pupil_diameter", "Pupil diameter"};
    case PupilMeasure::diameter_mm:
        return {"pupil_diameter", "Pupil diameter", "mm"};
    case PupilMeasure::none:
        return {"pupil_size",
                "1 while there is gaze: there is no pupil, and neither area nor diameter of one"};
    case PupilMeasure::unknown:
        break;
    }
    return {"pupil_size", "Pupil size; whether it is an area or a diameter the tracker does not say"};
}

} // namespace

PupilWords pupil_words(const SessionRecord& record) {
    std::map<int, PupilKind> kinds; ///< by sitting
    std::map<PupilMeasure, std::vector<int>> measures;
    for (const TrialRecord& trial : record.trials()) {
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
        measures[measure].push_back(trial.trial.index + 1);
    }
    if (measures.empty())
        return words_of_pupil(tracker_facts(record.header().tracker).pupil);
    if (measures.size() == 1)
        return words_of_pupil(measures.begin()->first);
    std::vector<std::string> parts;
    for (const auto& [measure, trials] : measures)
        parts.push_back(fmt::format("in {} {}: {}{}", trials.size() == 1 ? "trial" : "trials",
                                    fmt::join(trials, ", "), words_of_pupil(measure).meaning,
                                    words_of_pupil(measure).unit == "mm" ? " in mm" : ""));
    return {"pupil_size", fmt::format("Pupil size; {}", fmt::join(parts, "; "))};
}

} // namespace overt
