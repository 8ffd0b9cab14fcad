#include "experiment/study/area_pairs.h"

#include <algorithm>

#include "experiment/statistics/permutation.h"
#include "experiment/study/level_comparisons.h"
#include "experiment/study/study_pairs.h"

namespace overt {

namespace {

AreaPairRow area_row_of(std::span<const LevelComparison> comparisons, const std::string& area,
                        const StudyResults& results, const StudyOptions& options) {
    AreaPairRow row;
    row.area = area;
    struct Difference {
        std::size_t observer;
        std::optional<double> value;
    };
    std::vector<Difference> differences;
    for (const LevelComparison& one : comparisons) {
        differences.push_back({one.observer, area_difference(one, results, area)});
        row.comparisons += differences.back().value.has_value();
    }
    const std::vector<double> means = observer_means(std::span<const Difference>(differences),
                                                     [](const Difference& of) { return of.value; });
    row.observers = static_cast<int>(means.size());
    row.difference = estimated_mean(means, options.bootstrap(),
                                    comparisons.empty() ? "no observer saw an object in both levels"
                                                        : "no object that was compared has this area");
    if (const auto test = sign_flip_test(means, options.permutation()))
        row.p = test->p;
    row.evidence = options.evidence(means);
    return row;
}

/// After Holm, rows of groups among themselves and those over all groups among themselves.
void correct_areas(std::vector<AreaPairRow>& rows, const std::string& area,
                   std::optional<double> AreaPairRow::*corrected) {
    for (const bool of_groups : {false, true}) {
        std::vector<double> tested;
        std::vector<AreaPairRow*> own;
        for (AreaPairRow& row : rows) {
            if (row.keys.empty() != of_groups && row.p && (area.empty() || row.area == area)) {
                tested.push_back(*row.p);
                own.push_back(&row);
            }
        }
        const std::vector<double> after = holm(tested);
        for (std::size_t i = 0; i < own.size(); ++i)
            own[i]->*corrected = after[i];
    }
}

} // namespace

std::vector<AreaPairRow> area_pairs(const StudyResults& results, const std::vector<ObjectSurface>& surfaces,
                                    const LevelLists& levels, const StudyOptions& options) {
    const std::vector<std::string> compared = levels_of(results, options.compare, levels);
    const std::vector<StudyGroup> groups = make_groups(results, columns_beside_compared(options), levels);
    std::vector<AreaPairRow> rows;
    for (const std::string& area : results.compared_areas) {
        std::vector<std::vector<LevelComparison>> of_pair; ///< of all groups
        const auto add = [&](std::span<const LevelComparison> comparisons, const std::vector<StudyKey>& keys,
                             std::size_t a, std::size_t b) {
            AreaPairRow& row = rows.emplace_back(area_row_of(comparisons, area, results, options));
            row.keys = keys;
            row.column = options.compare;
            row.a = compared[a];
            row.b = compared[b];
        };
        for (const StudyGroup& group : groups) {
            std::size_t pair = 0;
            for (std::size_t a = 0; a < compared.size(); ++a) {
                for (std::size_t b = a + 1; b < compared.size(); ++b, ++pair) {
                    const std::vector<LevelComparison> comparisons = level_comparisons(
                        results, group.trials, surfaces, options.compare, compared[a], compared[b]);
                    add(comparisons, group.keys, a, b);
                    if (of_pair.size() <= pair)
                        of_pair.emplace_back();
                    of_pair[pair].insert(of_pair[pair].end(), comparisons.begin(), comparisons.end());
                }
            }
        }
        std::size_t pair = 0;
        for (std::size_t a = 0; groups.size() > 1 && a < compared.size(); ++a) {
            for (std::size_t b = a + 1; b < compared.size(); ++b, ++pair)
                add(of_pair[pair], {}, a, b);
        }
        correct_areas(rows, area, &AreaPairRow::p_holm);
    }
    correct_areas(rows, {}, &AreaPairRow::p_holm_areas);
    return rows;
}

} // namespace overt
