#include "experiment/study/level_comparisons.h"

#include <algorithm>

#include "experiment/statistics/point_spread.h"
#include "experiment/study/study_maps.h"

namespace overt {

namespace {

std::optional<double> wss_of(std::span<const StudyFixation* const> fixations) {
    std::vector<glm::dvec3> points;
    for (const StudyFixation* fixation : fixations)
        points.push_back(fixation->position);
    return unbiased_wss(points);
}

} // namespace

std::vector<LevelComparison> level_comparisons(const StudyResults& results, const std::vector<int>& trials,
                                               const std::vector<ObjectSurface>& surfaces,
                                               const std::string& column, const std::string& a,
                                               const std::string& b) {
    std::vector<std::string> observers;
    for (const StudyTrial& trial : results.trials) {
        const std::string& label = results.sessions[static_cast<std::size_t>(trial.session)].observer;
        if (std::find(observers.begin(), observers.end(), label) == observers.end())
            observers.push_back(label);
    }
    std::vector<LevelComparison> comparisons;
    for (const auto& [observer, own] : by_observer(results, trials)) {
        const auto number = static_cast<std::size_t>(std::find(observers.begin(), observers.end(), observer) -
                                                     observers.begin());
        std::vector<int> in_a, in_b;
        for (const int trial : own) {
            const std::string& level = results.trials[static_cast<std::size_t>(trial)].key(column);
            if (level == a)
                in_a.push_back(trial);
            else if (level == b)
                in_b.push_back(trial);
        }
        for (int object = 0; object < static_cast<int>(surfaces.size()); ++object) {
            if (!surfaces[static_cast<std::size_t>(object)].scale)
                continue;
            LevelComparison one{number, object, fixations_on(results, in_a, object),
                                fixations_on(results, in_b, object)};
            if (!one.a.empty() && !one.b.empty())
                comparisons.push_back(std::move(one));
        }
    }
    return comparisons;
}

std::optional<double> wss_difference_mm2(const LevelComparison& comparison, const ObjectScale& scale) {
    const std::optional<double> a = wss_of(comparison.a), b = wss_of(comparison.b);
    if (!a || !b)
        return std::nullopt;
    return (*a - *b) * scale.mm_per_unit * scale.mm_per_unit;
}

std::optional<double> wss_difference_deg2(const LevelComparison& comparison, const ObjectScale& scale) {
    const std::optional<double> mm2 = wss_difference_mm2(comparison, scale);
    return mm2 ? std::optional(*mm2 / (scale.mm_per_deg * scale.mm_per_deg)) : std::nullopt;
}

std::optional<double> area_difference(const LevelComparison& comparison, const StudyResults& results,
                                      std::string_view area) {
    const Areas& areas = results.objects[static_cast<std::size_t>(comparison.object)].areas;
    const std::optional<std::size_t> index = areas.find(area);
    if (!index)
        return std::nullopt;
    const auto share = [&](const std::vector<const StudyFixation*>& fixations) {
        const auto on_area = std::ranges::count_if(
            fixations, [&](const StudyFixation* one) { return areas.holds(*index, one->part); });
        return static_cast<double>(on_area) / static_cast<double>(fixations.size());
    };
    return share(comparison.a) - share(comparison.b);
}

} // namespace overt
