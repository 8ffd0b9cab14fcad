#include "experiment/study/scanpaths.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "experiment/base/parallel.h"
#include "experiment/statistics/bootstrap.h"
#include "experiment/statistics/scanpath_measures.h"

namespace overt {

namespace {

/// A number of trials that rows and differences have.
struct ScanpathNumber {
    const char* name;
    const char* unit;
    std::optional<double> TrialScanpath::*of_trial;
    Estimate ScanpathRow::*of_row;
    Interval range; ///< in which it can be
};

constexpr std::array scanpath_numbers{
    ScanpathNumber{"fixation_s", "s", &TrialScanpath::fixation_s, &ScanpathRow::fixation_s, from_zero_on},
    ScanpathNumber{"step_mm", "mm", &TrialScanpath::step_mm, &ScanpathRow::step_mm, from_zero_on},
    ScanpathNumber{"step_deg", "deg", &TrialScanpath::step_deg, &ScanpathRow::step_deg, from_zero_on},
    ScanpathNumber{"way_mm", "mm", &TrialScanpath::way_mm, &ScanpathRow::way_mm, from_zero_on},
    ScanpathNumber{"coverage", "", &TrialScanpath::coverage, &ScanpathRow::coverage, zero_to_one},
    ScanpathNumber{"effective_share", "", &TrialScanpath::entropy, &ScanpathRow::entropy, zero_to_one},
    ScanpathNumber{"recurrence", "", &TrialScanpath::recurrence, &ScanpathRow::recurrence, zero_to_one},
    ScanpathNumber{"determinism", "", &TrialScanpath::determinism, &ScanpathRow::determinism, zero_to_one},
    ScanpathNumber{"return_distance", "", &TrialScanpath::return_distance, &ScanpathRow::return_distance,
                   zero_to_one},
};

/// 2 to the entropy in bits of a map, over the area: 1 where it is even.
std::optional<double> effective_share(std::span<const double> map, std::span<const double> areas) {
    double mass = 0.0, area = 0.0;
    for (std::size_t i = 0; i < map.size(); ++i) {
        mass += map[i] * areas[i];
        area += areas[i];
    }
    if (!(mass > 0.0))
        return std::nullopt;
    double entropy = 0.0; // of the density, in nats
    for (std::size_t i = 0; i < map.size(); ++i) {
        const double density = map[i] / mass;
        if (density > 0.0 && areas[i] > 0.0)
            entropy -= areas[i] * density * std::log(density);
    }
    return std::exp(entropy) / area;
}

TrialScanpath scanpath_of(const StudyResults& results, int trial, const SurfaceDistances* distances,
                          const FixationMaps* maps) {
    const StudyTrial& of = results.trials[static_cast<std::size_t>(trial)];
    const StudyObject& object = results.objects[static_cast<std::size_t>(of.object)];
    TrialScanpath found;
    std::vector<const StudyFixation*> fixations;
    double seconds = 0.0, sigma_mm = 0.0;
    for_each_counted(results, trial, [&](const StudyFixation& fixation) {
        ++found.fixations;
        seconds += fixation.duration_s;
        if (fixation.triangle) {
            fixations.push_back(&fixation);
            sigma_mm += fixation.sigma_mm;
        }
    });
    if (found.fixations > 0)
        found.fixation_s = seconds / found.fixations;
    if (!distances || fixations.empty())
        return found;
    sigma_mm /= static_cast<double>(fixations.size());
    double way_mm = 0.0;
    int steps = 0;
    for (std::size_t i = 1; i < fixations.size(); ++i) {
        const double step = distances->between(*fixations[i - 1], *fixations[i]);
        if (std::isfinite(step)) {
            way_mm += step;
            ++steps;
        }
    }
    if (steps > 0) {
        found.way_mm = way_mm;
        found.step_mm = way_mm / steps;
        if (object.mm_per_deg && *object.mm_per_deg > 0.0)
            found.step_deg = *found.step_mm / *object.mm_per_deg;
    }
    if (sigma_mm > 0.0) {
        found.coverage = distances->covered(fixations, sigma_mm);
        if (const auto of_trial = recurrence(fixations.size(), [&](std::size_t i, std::size_t j) {
                return distances->between(*fixations[i], *fixations[j]) <= sigma_mm;
            })) {
            found.recurrence = of_trial->recurrence;
            found.determinism = of_trial->determinism;
            found.return_distance = of_trial->return_distance;
        }
    }
    if (maps)
        found.entropy = effective_share(maps->sum_of(fixations), maps->visible_areas());
    return found;
}

ScanpathRow scanpath_row(const StudyResults& results, const std::vector<TrialScanpath>& scanpaths,
                         const StudyGroup& group, const StudyOptions& options) {
    ScanpathRow row;
    row.keys = group.keys;
    std::vector<double> counts;
    std::array<std::vector<double>, scanpath_numbers.size()> means;
    for (const auto& [observer, trials] : by_observer(results, group.trials)) {
        double fixations = 0.0;
        std::array<std::pair<double, int>, scanpath_numbers.size()> sums{};
        for (const int trial : trials) {
            const TrialScanpath& of = scanpaths[static_cast<std::size_t>(trial)];
            fixations += of.fixations;
            row.trials += of.fixations > 0;
            for (std::size_t i = 0; i < scanpath_numbers.size(); ++i) {
                if (const std::optional<double>& value = of.*scanpath_numbers[i].of_trial) {
                    sums[i].first += *value;
                    ++sums[i].second;
                }
            }
        }
        counts.push_back(fixations / static_cast<double>(trials.size()));
        for (std::size_t i = 0; i < sums.size(); ++i) {
            if (sums[i].second > 0)
                means[i].push_back(sums[i].first / sums[i].second);
        }
    }
    row.observers = static_cast<int>(counts.size());
    row.fixations = estimated_mean(counts, options.bootstrap(), "there is no trial", from_zero_on);
    for (std::size_t i = 0; i < scanpath_numbers.size(); ++i) {
        const ScanpathNumber& number = scanpath_numbers[i];
        row.*number.of_row = estimated_mean(means[i], options.bootstrap(),
                                            "no trial has fixations that tell it", number.range);
    }
    return row;
}

} // namespace

ObjectDistances surface_distances(const StudyResults& results, const std::vector<ObjectSurface>& surfaces) {
    ObjectDistances distances;
    for (std::size_t object = 0; object < results.objects.size(); ++object) {
        const ObjectSurface& surface = surfaces[object];
        bool any = false;
        for_each_counted_on(results, static_cast<int>(object), [&](const StudyFixation&) { any = true; });
        distances.push_back(
            surface.geometry && surface.scale && any
                ? std::make_unique<SurfaceDistances>(results, static_cast<int>(object), surface)
                : nullptr);
    }
    return distances;
}

std::vector<TrialScanpath> trial_scanpaths(const StudyResults& results, const ObjectDistances& distances,
                                           const ObjectFixationMaps& maps) {
    std::vector<TrialScanpath> found(results.trials.size());
    parallel_for(static_cast<int>(found.size()), [&](int trial) {
        const auto object = static_cast<std::size_t>(results.trials[static_cast<std::size_t>(trial)].object);
        found[static_cast<std::size_t>(trial)] =
            scanpath_of(results, trial, distances[object].get(), maps[object].get());
    });
    return found;
}

std::vector<ScanpathRow> scanpath_rows(const StudyResults& results,
                                       const std::vector<TrialScanpath>& scanpaths, const LevelLists& levels,
                                       const StudyOptions& options) {
    std::vector<StudyGroup> groups = results.by.size() > 1 ? results.groups : std::vector<StudyGroup>();
    std::ranges::move(all_and_levels(results, results.by, levels), std::back_inserter(groups));
    std::vector<ScanpathRow> rows;
    for (const StudyGroup& group : groups)
        rows.push_back(scanpath_row(results, scanpaths, group, options));
    return rows;
}

std::vector<MeasureOfTrials> scanpath_measures(const std::vector<TrialScanpath>& scanpaths) {
    std::vector<MeasureOfTrials> measures;
    measures.push_back({"fixations", "", "", [&scanpaths](int trial) {
                            return MeasureSums{
                                static_cast<double>(scanpaths[static_cast<std::size_t>(trial)].fixations),
                                1.0};
                        }});
    for (const ScanpathNumber& number : scanpath_numbers) {
        measures.push_back({number.name, "", number.unit, [&scanpaths, number](int trial) {
                                const std::optional<double>& value =
                                    scanpaths[static_cast<std::size_t>(trial)].*number.of_trial;
                                return value ? MeasureSums{*value, 1.0} : MeasureSums{};
                            }});
    }
    return measures;
}

} // namespace overt
