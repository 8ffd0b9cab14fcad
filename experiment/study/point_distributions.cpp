#include "experiment/study/point_distributions.h"

#include <algorithm>

#include "experiment/statistics/point_spread.h"
#include "experiment/study/study_maps.h"

namespace overt {

namespace {

Interval scaled(const Interval& interval, double factor) {
    return {interval.low * factor, interval.high * factor};
}

DistributionRow distribution_of(const StudyResults& results, int group, int object,
                                const std::optional<ObjectScale>& scale, const StudyOptions& options) {
    DistributionRow row;
    row.group = group;
    row.object = object;
    std::vector<std::vector<glm::dvec3>> of_observer;
    std::vector<glm::dvec3> all;
    for (const auto& [observer, trials] :
         by_observer(results, results.groups[static_cast<std::size_t>(group)].trials)) {
        std::vector<glm::dvec3> points;
        for (const StudyFixation* fixation : fixations_on(results, trials, object))
            points.push_back(fixation->position);
        if (points.empty())
            continue;
        all.insert(all.end(), points.begin(), points.end());
        of_observer.push_back(std::move(points));
    }
    row.observers = static_cast<int>(of_observer.size());
    row.fixations = static_cast<int>(all.size());
    const std::optional<PointSpread> spread = point_spread(all);
    const std::string absent = all.empty()       ? "no fixation was counted"
                               : all.size() == 1 ? "one fixation alone has no spread"
                                                 : "the camera or the screen is not known";
    if (all.size() < 2 || !scale) {
        row.wss_mm2 = row.wss_deg2 = Estimate::none(absent);
        return row;
    }
    const double mm2 = scale->mm_per_unit * scale->mm_per_unit;
    const double deg2 = mm2 / (scale->mm_per_deg * scale->mm_per_deg);
    const std::optional<Interval> interval = interval_in_range(
        static_cast<std::uint32_t>(of_observer.size()),
        [&](std::span<const std::uint32_t> drawn) -> std::optional<double> {
            std::vector<glm::dvec3> points;
            for (const std::uint32_t i : drawn)
                points.insert(points.end(), of_observer[i].begin(), of_observer[i].end());
            const std::optional<PointSpread> of_drawn = point_spread(points);
            return of_drawn ? std::optional(of_drawn->wss()) : std::nullopt;
        },
        options.bootstrap(), from_zero_on);
    row.wss_mm2 = Estimate::of(spread->wss() * mm2);
    row.wss_deg2 = Estimate::of(spread->wss() * deg2);
    if (interval) {
        row.wss_mm2.interval = scaled(*interval, mm2);
        row.wss_deg2.interval = scaled(*interval, deg2);
    }
    for (int axis = 0; axis < 3; ++axis) {
        row.variance_mm2[static_cast<std::size_t>(axis)] = spread->variance[axis] * mm2;
        row.variance_deg2[static_cast<std::size_t>(axis)] = spread->variance[axis] * deg2;
    }
    return row;
}

} // namespace

std::vector<DistributionRow> point_distributions(const StudyResults& results,
                                                 const std::vector<ObjectSurface>& surfaces,
                                                 const StudyOptions& options) {
    std::vector<DistributionRow> rows;
    for (int group = 0; group < static_cast<int>(results.groups.size()); ++group) {
        for (const int object : objects_of(results, results.groups[static_cast<std::size_t>(group)])) {
            rows.push_back(distribution_of(results, group, object,
                                           surfaces[static_cast<std::size_t>(object)].scale, options));
            const auto map = std::find_if(results.maps.begin(), results.maps.end(), [&](const StudyMap& one) {
                return one.group == group && one.object == object &&
                       one.weighting == MapWeighting::duration && one.absent.empty();
            });
            if (map != results.maps.end()) {
                rows.back().map_peak = map->peak;
                rows.back().map_mean = map->mean;
            }
        }
    }
    return rows;
}

} // namespace overt
