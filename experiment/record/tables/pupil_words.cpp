#include "experiment/record/tables/pupil_words.h"

#include <map>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

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

} // namespace

std::string pupil_words(const SessionRecord& record) {
    std::map<int, PupilKind> kinds; ///< by sitting
    std::vector<int> with_diameters;
    std::size_t trials = 0;
    for (const TrialRecord& trial : record.trials()) {
        ++trials;
        const std::optional<GazeSource> source = record.gaze_source(trial.sitting);
        if (!source)
            continue;
        const auto [kind, is_new] = kinds.try_emplace(trial.sitting, source->pupil_is_diameter);
        const auto take = [&kind = kind->second](const GazeEvent& event) { kind.take(event); };
        if (is_new)
            record.read_gaze_events_before(take);
        record.read_gaze_events(trial, take);
        if (kind->second.is_diameter())
            with_diameters.push_back(trial.trial.index + 1);
        record.read_gaze_events_after(trial, take);
    }
    if (with_diameters.empty())
        return "Pupil area";
    if (with_diameters.size() == trials)
        return "Pupil diameter";
    return fmt::format("Pupil area; in {} {} pupil diameter", with_diameters.size() == 1 ? "trial" : "trials",
                       fmt::join(with_diameters, ", "));
}

} // namespace overt
