#include "experiment/study/read/trial_screen_areas.h"

#include <algorithm>

#include "experiment/screen_areas/interest_area_text.h"
#include "experiment/study/fixations/trial_presentation.h"

namespace overt {

RecordedScreenAreas recorded_screen_areas(const SessionRecord& record, const TrialRecord& trial) {
    RecordedScreenAreas found;
    if (!record.gaze_source(trial.sitting))
        return found;
    const std::optional<ClockMap> clock_map = record.clock_map(trial);
    const SessionTime onset = presentation_of(record.header(), trial, false, {}).onset;
    record.read_gaze_events(trial, [&](const GazeEvent& event) {
        if (event.kind != GazeEvent::Kind::message)
            return;
        const std::optional<std::string_view> words = interest_area_words(event.text);
        if (!words)
            return;
        if (std::optional<std::string> file = interest_area_file(*words)) {
            if (std::ranges::find(found.files, *file) == found.files.end())
                found.files.push_back(*std::move(file));
            return;
        }
        const double after_s = clock_map ? to_seconds(clock_map->to_session(event.start).time - onset) : 0.0;
        InterestArea area = interest_area(*words, after_s);
        if (auto* const fault = std::get_if<std::string>(&area))
            found.faults.push_back("\"" + event.text + "\": " + *fault);
        else
            found.areas.push_back(std::get<ScreenArea>(std::move(area)));
    });
    return found;
}

std::vector<ScreenArea> chosen_screen_areas(std::span<const ChosenScreenArea> chosen,
                                            const StudyTrial& trial) {
    std::vector<ScreenArea> areas;
    for (const ChosenScreenArea& one : chosen) {
        const bool is_of_trial = std::ranges::all_of(
            one.trials, [&](const auto& wanted) { return trial.key(wanted.first) == wanted.second; });
        if (is_of_trial)
            areas.push_back(one.area);
    }
    return areas;
}

std::vector<std::string> unknown_columns(std::span<const ChosenScreenArea> chosen,
                                         const StudyResults& results) {
    std::vector<std::string> unknown;
    for (const ChosenScreenArea& one : chosen) {
        for (const auto& [column, value] : one.trials) {
            const bool is_known = std::ranges::any_of(results.trials, [&](const StudyTrial& trial) {
                return std::ranges::find(trial.keys, column, &StudyKey::column) != trial.keys.end();
            });
            if (!is_known && std::ranges::find(unknown, column) == unknown.end())
                unknown.push_back(column);
        }
    }
    return unknown;
}

} // namespace overt
