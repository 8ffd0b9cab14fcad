#include "experiment/study/area_shares.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiment/base/error.h"
#include "experiment/statistics/proportion.h"
#include "experiment/study/area_looks.h"
#include "experiment/study/read/area_evidence.h"
#include "experiment/study/time_clusters.h"

namespace overt {

namespace {

/// On the area, and all.
struct AreaSum {
    double inside = 0.0, all = 0.0;
    void add(bool is_inside, double weight) {
        all += weight;
        inside += is_inside ? weight : 0.0;
    }
    std::optional<double> share() const { return all > 0.0 ? std::optional(inside / all) : std::nullopt; }
};

Estimate estimated_share(const std::vector<double>& shares, const StudyOptions& options,
                         const std::string& reason) {
    return estimated_mean(shares, options.bootstrap(), reason, zero_to_one);
}

const std::string no_error = "no validation tells the tracker's error, or there are too few fixations";
const std::string no_fixation = "no fixation was counted on an object with this area";

/// Of an estimate that is no smaller than 0, by a number that is known.
Estimate times(const Estimate& estimate, const std::optional<double>& by, const std::string& reason) {
    if (!estimate.value || !by || !(*by > 0.0))
        return Estimate::none(estimate.value ? reason : estimate.absent);
    Estimate product = Estimate::of(*estimate.value / *by);
    if (estimate.interval)
        product.interval = {estimate.interval->low / *by, estimate.interval->high / *by};
    return product;
}

/// What even gaze would give, on the objects that these fixations are on.
void add_baselines(AreaRow& row, const StudyResults& results,
                   const std::map<int, int>& fixations_on_objects) {
    double surface = 0.0, exposure = 0.0;
    int known = 0, all = 0;
    for (const auto& [object, fixations] : fixations_on_objects) {
        all += fixations;
        const auto found = std::ranges::find_if(results.exposures, [&, on = object](const ExposureRow& of) {
            return of.object == on && of.area == row.area;
        });
        if (found == results.exposures.end())
            continue;
        known += fixations;
        surface += fixations * found->share_of_area;
        exposure += fixations * found->share_of_exposure;
    }
    if (known > 0 && known == all) {
        row.share_of_surface = surface / known;
        row.share_of_exposure = exposure / known;
    }
    const std::string unknown = "the surface is not known, or none of the area is seen";
    row.over_surface = times(row.by_count, row.share_of_surface, unknown);
    row.over_exposure = times(row.by_count, row.share_of_exposure, unknown);
}

AreaRow row_of_area(const StudyResults& results, const std::string& area, const std::vector<StudyKey>& keys,
                    const std::vector<int>& trials, const StudyOptions& options) {
    AreaRow row;
    row.area = area;
    row.keys = keys;
    row.trials = static_cast<int>(trials.size());
    std::vector<double> counts, durations;
    std::vector<std::vector<AreaEvidence>> evidence; ///< by observer
    AreaSum pooled;
    std::map<int, int> on_objects;
    std::vector<std::vector<int>> trials_of_observers;
    for (auto& [observer, own] : by_observer(results, trials)) {
        AreaSum count, duration;
        std::vector<AreaEvidence>& told_by_observer = evidence.emplace_back();
        for (const int trial : own) {
            const StudyTrial& of = results.trials[static_cast<std::size_t>(trial)];
            const Areas& areas = results.objects[static_cast<std::size_t>(of.object)].areas;
            const std::optional<std::size_t> index = areas.find(area);
            if (!index)
                continue;
            for_each_counted(results, trial, [&](const StudyFixation& fixation) {
                if (!fixation.part)
                    return;
                const bool is_inside = areas.holds(*index, fixation.part);
                count.add(is_inside, 1.0);
                duration.add(is_inside, fixation.duration_s);
                pooled.add(is_inside, 1.0);
                ++on_objects[of.object];
            });
            for (std::size_t i = of.first_fixation; i < of.first_fixation + of.fixations; ++i) {
                const std::vector<AreaEvidence>& told = results.fixations[i].evidence;
                if (*index < told.size() && told[*index].tells())
                    told_by_observer.push_back(told[*index]);
            }
        }
        if (count.share())
            counts.push_back(*count.share());
        if (duration.share())
            durations.push_back(*duration.share());
        trials_of_observers.push_back(own);
    }
    row.observers = static_cast<int>(counts.size());
    row.fixations = static_cast<int>(pooled.all);
    row.by_count = estimated_share(counts, options, no_fixation);
    row.of_observers = counts;
    row.by_duration = estimated_share(durations, options, no_fixation);
    row.corrected = estimated_share(shares_of_observers(evidence), options, no_error);
    if (row.corrected.value)
        row.corrected.value = std::clamp(*row.corrected.value, 0.0, 1.0);
    row.pooled = pooled.share();
    row.pooled_interval = wilson_interval(pooled.inside, pooled.all, options.confidence);
    add_baselines(row, results, on_objects);
    add_looks(row, results, trials_of_observers, options.bootstrap());
    return row;
}

} // namespace

void name_areas(StudyResults& results, const StudyOptions& options) {
    results.areas.clear();
    for (const StudyObject& object : results.objects) {
        for (const std::string& area : object.areas.names()) {
            if (std::ranges::find(results.areas, area) == results.areas.end())
                results.areas.push_back(area);
        }
    }
    for (const std::string& area : options.areas) {
        if (std::ranges::find(results.areas, area) == results.areas.end())
            throw InputError(fmt::format("--area {}: no object has an area of this name; {}.", area,
                                         results.areas.empty()
                                             ? std::string("there are none")
                                             : fmt::format("there are {}", fmt::join(results.areas, ", "))));
    }
    results.compared_areas = options.areas.empty() ? results.areas : options.areas;
    results.area = options.areas.empty() ? std::string(usual_area(results.areas)) : options.areas.front();
}

std::optional<bool> is_on_area(const StudyResults& results, const StudyFixation& fixation,
                               std::string_view area) {
    const StudyTrial& trial = results.trials[static_cast<std::size_t>(fixation.trial)];
    const Areas& areas = results.objects[static_cast<std::size_t>(trial.object)].areas;
    const std::optional<std::size_t> index = areas.find(area);
    if (!fixation.part || !index)
        return std::nullopt;
    return areas.holds(*index, fixation.part);
}

std::vector<AreaRow> area_rows(const StudyResults& results, const LevelLists& order,
                               const StudyOptions& options) {
    std::vector<StudyGroup> groups = results.groups;
    const auto append = [&](std::vector<StudyGroup> more) {
        std::ranges::move(more, std::back_inserter(groups));
    };
    if (results.by.size() > 1) {
        for (const std::string& column : results.by)
            append(make_groups(results, {column}, order));
    }
    if (!results.by.empty())
        append(make_groups(results, {}, order));
    std::vector<AreaRow> rows;
    for (const std::string& area : results.areas) {
        for (const StudyGroup& group : groups)
            rows.push_back(row_of_area(results, area, group.keys, group.trials, options));
    }
    return rows;
}

std::vector<AreaRow> rows_of_figure_area(const StudyResults& results) {
    std::vector<AreaRow> rows;
    std::ranges::copy_if(results.area_rows, std::back_inserter(rows),
                         [&](const AreaRow& row) { return row.area == results.area; });
    return rows;
}

std::vector<TimeCourseRow> area_time_course(const StudyResults& results, const LevelLists& order,
                                            const StudyOptions& options) {
    std::vector<TimeCourseRow> rows;
    const double end_s = longest_presentation_s(results);
    const int stretches = stretches_of_time(results, options.time_step_s);
    std::vector<std::string> columns;
    if (!results.by.empty())
        columns.push_back(results.by.front());
    const std::vector<StudyGroup> levels = make_groups(results, columns, order);
    for (const std::string& area : results.areas) {
        for (const StudyGroup& level : levels) {
            const auto observers = by_observer(results, level.trials);
            std::vector<std::vector<AreaSum>> sums(observers.size(),
                                                   std::vector<AreaSum>(static_cast<std::size_t>(stretches)));
            for (std::size_t o = 0; o < observers.size(); ++o) {
                for (const int trial : observers[o].second) {
                    for_each_counted(results, trial, [&](const StudyFixation& fixation) {
                        const std::optional<bool> is_inside = is_on_area(results, fixation, area);
                        const double end = fixation.onset_s + fixation.duration_s;
                        const int first =
                            std::max(0, static_cast<int>(fixation.onset_s / options.time_step_s));
                        for (int i = first; is_inside && i < stretches && i * options.time_step_s < end;
                             ++i) {
                            const double from = std::max(fixation.onset_s, i * options.time_step_s),
                                         to = std::min(end, (i + 1) * options.time_step_s);
                            sums[o][static_cast<std::size_t>(i)].add(*is_inside, std::max(to - from, 0.0));
                        }
                    });
                }
            }
            for (int i = 0; i < stretches; ++i) {
                std::vector<double> shares;
                for (const auto& of_observer : sums) {
                    if (const auto share = of_observer[static_cast<std::size_t>(i)].share())
                        shares.push_back(*share);
                }
                TimeCourseRow row;
                row.area = area;
                if (!level.keys.empty())
                    row.key = level.keys.front();
                row.from_s = i * options.time_step_s;
                row.to_s = std::min((i + 1) * options.time_step_s, end_s);
                row.observers = static_cast<int>(shares.size());
                row.share = estimated_share(shares, options, no_fixation);
                rows.push_back(std::move(row));
            }
        }
    }
    return rows;
}

} // namespace overt
