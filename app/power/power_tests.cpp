#include "app/power/power_tests.h"

#include <algorithm>
#include <numeric>

#include "app/power/effect_tests.h"
#include "experiment/statistics/swap_test.h"

namespace overt {

namespace {

struct ObserverValue {
    std::size_t observer = 0;
    std::optional<double> value;
};

StudyOutcome flipped(std::span<const ObserverValue> values, int observers,
                     const PermutationSettings& settings, const std::optional<double>& equivalence) {
    std::vector<ObserverValue> own;
    for (const ObserverValue& one : values) {
        if (one.observer < static_cast<std::size_t>(observers))
            own.push_back(one);
    }
    const std::vector<double> means =
        observer_means(std::span<const ObserverValue>(own), [](const ObserverValue& of) { return of.value; });
    return outcome_of(means, settings, equivalence);
}

std::vector<PairedMaps> paired_maps(const std::vector<std::vector<LevelComparison>>& cells,
                                    std::span<const std::unique_ptr<VertexMaps>> maps) {
    std::vector<PairedMaps> surfaces;
    for (const std::vector<LevelComparison>& cell : cells) {
        for (std::size_t object = 0; object < maps.size(); ++object) {
            if (!maps[object])
                continue;
            PairedMaps paired(maps[object]->areas());
            for (const LevelComparison& one : cell) {
                if (static_cast<std::size_t>(one.object) == object)
                    paired.add(one.observer, maps[object]->sum_of(one.a), maps[object]->sum_of(one.b));
            }
            if (!paired.observers().empty())
                surfaces.push_back(std::move(paired));
        }
    }
    return surfaces;
}

} // namespace

std::vector<std::vector<LevelComparison>>
compared_cells(const GazeStudies& studies, const StudyResults& results, const PowerEffect& effect) {
    std::vector<std::string> within;
    if (effect.column != "task")
        within.emplace_back("task");
    std::vector<std::vector<LevelComparison>> cells;
    for (const StudyGroup& group : make_groups(results, within, studies.levels())) {
        std::vector<int> trials;
        for (const int trial : group.trials) {
            const StudyTrial& of = results.trials[static_cast<std::size_t>(trial)];
            if (std::ranges::all_of(effect.within,
                                    [&](const StudyKey& key) { return of.key(key.column) == key.value; }))
                trials.push_back(trial);
        }
        cells.push_back(level_comparisons(results, trials, studies.surfaces(), effect.column, effect.level,
                                          effect.against));
    }
    return cells;
}

std::vector<StudyOutcome> tested(const GazeStudies& studies, const StudyResults& results,
                                 const PowerEffect& effect, std::span<const int> observers,
                                 std::span<const std::unique_ptr<VertexMaps>> maps,
                                 const PermutationSettings& settings,
                                 const std::optional<double>& equivalence) {
    if (effect.test == PowerTest::cluster)
        return tested_clusters(studies, results, effect, observers, maps, settings);
    if (effect.test != PowerTest::pair)
        return tested_factors(studies, results, effect, observers, settings);
    const std::vector<std::vector<LevelComparison>> cells = compared_cells(studies, results, effect);
    std::vector<StudyOutcome> outcomes;
    if (effect.measure == PowerMeasure::cc) {
        const std::vector<PairedMaps> surfaces = paired_maps(cells, maps);
        for (const int count : observers) {
            StudyOutcome outcome;
            if (const auto test = swap_test(surfaces, static_cast<std::size_t>(count), settings)) {
                outcome.p = test->test.p;
                outcome.estimate = test->correlation;
            }
            outcomes.push_back(outcome);
        }
        return outcomes;
    }
    std::vector<ObserverValue> values;
    for (const std::vector<LevelComparison>& cell : cells) {
        for (const LevelComparison& one : cell) {
            const auto& scale = studies.surfaces()[static_cast<std::size_t>(one.object)].scale;
            values.push_back({one.observer, effect.measure == PowerMeasure::area
                                                ? area_difference(one, results, effect.area)
                                                : wss_difference_deg2(one, *scale)});
        }
    }
    for (const int count : observers)
        outcomes.push_back(flipped(values, count, settings, equivalence));
    return outcomes;
}

} // namespace overt
