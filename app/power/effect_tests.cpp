#include "app/power/effect_tests.h"

#include <algorithm>
#include <numeric>

#include "experiment/statistics/cluster_test.h"
#include "experiment/study/factor_effects.h"
#include "experiment/study/level_comparisons.h"

namespace overt {

namespace {

/// Two levels of one object, and whether they are those of the effect.
struct ComparedObject {
    std::vector<std::vector<float>> differences; ///< by observer
    std::vector<std::size_t> observers;
    const VertexMaps* maps = nullptr;
    bool is_of_effect = false;
};

std::vector<float> share_difference(const LevelComparison& of, const VertexMaps& maps) {
    const std::vector<double> a = maps.share_of_time(of.a), b = maps.share_of_time(of.b);
    std::vector<float> difference(a.size());
    for (std::size_t v = 0; v < a.size(); ++v)
        difference[v] = static_cast<float>(a[v] - b[v]);
    return difference;
}

std::vector<ComparedObject> compared_objects(const GazeStudies& studies, const StudyResults& results,
                                             const PowerEffect& effect,
                                             std::span<const std::unique_ptr<VertexMaps>> maps) {
    std::vector<ComparedObject> compared;
    std::vector<int> trials(results.trials.size());
    std::iota(trials.begin(), trials.end(), 0);
    const std::vector<std::string> levels = levels_of(results, effect.column, studies.levels());
    for (std::size_t a = 0; a < levels.size(); ++a)
        for (std::size_t b = a + 1; b < levels.size(); ++b) {
            const std::vector<LevelComparison> found =
                level_comparisons(results, trials, studies.surfaces(), effect.column, levels[a], levels[b]);
            const bool is_of_effect = (levels[a] == effect.level && levels[b] == effect.against) ||
                                      (levels[b] == effect.level && levels[a] == effect.against);
            for (std::size_t object = 0; object < maps.size(); ++object) {
                if (!maps[object])
                    continue;
                ComparedObject& one = compared.emplace_back();
                one.maps = maps[object].get();
                one.is_of_effect = is_of_effect;
                for (const LevelComparison& of : found)
                    if (static_cast<std::size_t>(of.object) == object) {
                        one.differences.push_back(share_difference(of, *one.maps));
                        one.observers.push_back(of.observer);
                    }
            }
        }
    return compared;
}

StudyOutcome clusters_of_first(const std::vector<ComparedObject>& compared, int observers,
                               const PermutationSettings& permutations) {
    ClusterTestSettings settings;
    settings.permutations = permutations.permutations;
    settings.seed = permutations.seed;
    settings.all_observers = static_cast<std::size_t>(observers);
    settings.most_threads = 1; // studies are simulated side by side
    std::vector<ClusterTest> tests;
    std::vector<bool> is_of_effect;
    for (const ComparedObject& one : compared) {
        std::vector<std::vector<float>> own;
        settings.observers.clear();
        for (std::size_t i = 0; i < one.observers.size(); ++i)
            if (one.observers[i] < static_cast<std::size_t>(observers)) {
                own.push_back(one.differences[i]);
                settings.observers.push_back(one.observers[i]);
            }
        if (own.size() < 2)
            continue;
        tests.push_back(cluster_test(own, one.maps->areas(), one.maps->adjacency(), settings));
        is_of_effect.push_back(one.is_of_effect);
    }
    StudyOutcome outcome;
    if (std::ranges::find(is_of_effect, true) == is_of_effect.end())
        return outcome;
    outcome.p = 1.0;
    int found = 0;
    constexpr double usual_level = 0.05;
    const std::vector<std::vector<double>> p = p_over_tests(tests);
    for (std::size_t i = 0; i < tests.size(); ++i)
        for (const double of_cluster : p[i]) {
            if (!is_of_effect[i])
                continue;
            outcome.p = std::min(*outcome.p, of_cluster);
            found += of_cluster <= usual_level;
        }
    outcome.estimate = found;
    return outcome;
}

/// Trials and fixations of the first observers alone, as the tests of factors ask for them.
StudyResults of_first(const StudyResults& results, int observers) {
    StudyResults first = results;
    std::erase_if(first.trials, [&](const StudyTrial& trial) { return trial.session >= observers; });
    return first;
}

} // namespace

std::vector<std::string> columns_of_test(const PowerEffect& effect) {
    std::vector<std::string> columns{"task"};
    const auto add = [&](const std::string& column) {
        if (std::ranges::find(columns, column) == columns.end())
            columns.push_back(column);
    };
    add(effect.column);
    if (effect.test == PowerTest::interaction)
        add(effect.interacting_column());
    return columns;
}

std::vector<StudyOutcome> tested_factors(const GazeStudies& studies, const StudyResults& results,
                                         const PowerEffect& effect, std::span<const int> observers,
                                         const PermutationSettings& settings) {
    StudyOptions options;
    options.by = columns_of_test(effect);
    options.seed = settings.seed;
    // StudyOptions::permutation() makes five times as many.
    options.permutations = std::max(1, settings.permutations / 5);
    StudyResults all = results;
    all.by = options.by;
    all.areas.clear();
    if (effect.measure == PowerMeasure::area) {
        all.areas = {effect.area};
        for (StudyObject& object : all.objects)
            object.mm_per_unit.reset(); // nobody asks for WSS
    }
    all.compared_areas = all.areas;
    const bool is_interaction = effect.test == PowerTest::interaction;
    const auto is_its_row = [&](const FactorEffectRow& row) {
        if (!is_interaction)
            return row.effect == effect.column;
        const std::string& other = effect.interacting_column();
        return row.effect == effect.column + ":" + other || row.effect == other + ":" + effect.column;
    };
    std::vector<StudyOutcome> outcomes;
    for (const int count : observers) {
        StudyOutcome& outcome = outcomes.emplace_back();
        for (const FactorEffectRow& row : factor_effects(of_first(all, count), studies.levels(), options))
            if (is_its_row(row) && (effect.measure == PowerMeasure::area) != (row.measure == "log WSS")) {
                outcome.p = row.p;
                outcome.estimate = row.statistic;
            }
    }
    return outcomes;
}

std::vector<StudyOutcome> tested_clusters(const GazeStudies& studies, const StudyResults& results,
                                          const PowerEffect& effect, std::span<const int> observers,
                                          std::span<const std::unique_ptr<VertexMaps>> maps,
                                          const PermutationSettings& settings) {
    const std::vector<ComparedObject> compared = compared_objects(studies, results, effect, maps);
    std::vector<StudyOutcome> outcomes;
    for (const int count : observers)
        outcomes.push_back(clusters_of_first(compared, count, settings));
    return outcomes;
}

} // namespace overt
