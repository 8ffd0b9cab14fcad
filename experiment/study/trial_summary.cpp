#include "experiment/study/trial_summary.h"

#include <utility>
#include <vector>

#include "experiment/statistics/point_spread.h"

namespace overt {

TrialSummaryRow trial_summary(const StudyResults& results, const StudyTrial& trial) {
    const StudyObject& object = results.objects[static_cast<std::size_t>(trial.object)];
    TrialSummaryRow row{trial, 0, 0.0, {}, {}};
    for (const std::string& area : results.areas)
        row.areas.push_back(object.areas.has(area) ? std::optional<TrialSummaryRow::OnArea>(std::in_place)
                                                   : std::nullopt);
    std::vector<glm::dvec3> points;
    for (std::size_t i = trial.first_fixation; i < trial.first_fixation + trial.fixations; ++i) {
        const StudyFixation& fixation = results.fixations[i];
        if (!fixation.counted())
            continue;
        ++row.counted;
        row.counted_s += fixation.duration_s;
        for (std::size_t area = 0; area < row.areas.size(); ++area) {
            const std::optional<std::size_t> own = object.areas.find(results.areas[area]);
            if (own && object.areas.holds(*own, fixation.part)) {
                ++row.areas[area]->fixations;
                row.areas[area]->seconds += fixation.duration_s;
            }
        }
        points.push_back(fixation.position);
    }
    const std::optional<double> wss = unbiased_wss(points);
    if (wss && object.mm_per_unit)
        row.wss_mm2 = *wss * *object.mm_per_unit * *object.mm_per_unit;
    return row;
}

} // namespace overt
