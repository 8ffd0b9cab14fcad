#include "experiment/study/light_at_gaze.h"

#include <algorithm>

namespace overt {

namespace {

LightAtGazeRow light_of(const StudyResults& results, const StudyGroup& group, const StudyOptions& options) {
    LightAtGazeRow row;
    row.keys = group.keys;
    std::vector<double> met, over_place, over_point;
    for (const auto& [observer, trials] : by_observer(results, group.trials)) {
        double seconds = 0.0, lightness = 0.0, place = 0.0, point = 0.0;
        for (const int trial : trials) {
            for_each_counted(results, trial, [&](const StudyFixation& fixation) {
                if (!fixation.light)
                    return;
                seconds += fixation.duration_s;
                lightness += fixation.duration_s * fixation.light->met;
                place += fixation.duration_s * (fixation.light->met - fixation.light->at_place);
                point += fixation.duration_s * (fixation.light->met - fixation.light->at_point);
                ++row.fixations;
            });
        }
        if (!(seconds > 0.0))
            continue;
        met.push_back(lightness / seconds);
        over_place.push_back(place / seconds);
        over_point.push_back(point / seconds);
    }
    row.observers = static_cast<int>(met.size());
    const std::string absent = "the light of no counted fixation is known";
    row.lightness = estimated_mean(met, options.bootstrap(), absent);
    row.over_place = estimated_mean(over_place, options.bootstrap(), absent);
    row.over_point = estimated_mean(over_point, options.bootstrap(), absent);
    return row;
}

} // namespace

std::vector<LightAtGazeRow> lights_at_gaze(const StudyResults& results, const LevelLists& levels,
                                           const StudyOptions& options) {
    if (std::ranges::none_of(results.fixations,
                             [](const auto& fixation) { return fixation.light.has_value(); }))
        return {};
    std::vector<LightAtGazeRow> rows;
    for (const StudyGroup& group : all_and_levels(results, options.by, levels))
        rows.push_back(light_of(results, group, options));
    return rows;
}

} // namespace overt
