#include "experiment/study/study_pairs.h"

#include <algorithm>
#include <array>
#include <map>
#include <memory>

#include <fmt/format.h>

#include "experiment/base/parallel.h"
#include "experiment/base/random.h"
#include "experiment/statistics/map_similarity.h"
#include "experiment/statistics/point_spread.h"
#include "experiment/statistics/split_half.h"
#include "experiment/study/study_maps.h"

namespace overt {

namespace {

/// CC and both SIMs.
struct Similarities {
    static constexpr int count = 3;
    std::array<std::optional<double>, count> values;
};

Similarities similarities(std::span<const double> a, std::span<const double> b,
                          std::span<const double> areas) {
    return {{correlation(a, b, areas), similarity(a, b, areas, SimConvention::mit),
             similarity(a, b, areas, SimConvention::pysaliency)}};
}

/// One observer's fixations on one sculpture in both levels.
struct Comparison {
    std::size_t observer;
    int sculpture;
    Fixations a, b;
    // What is reckoned of it.
    std::optional<double> wss_difference_mm2, wss_difference_deg2;
    Similarities found, ceiling;
    std::vector<Similarities> permuted;
};

Fixations chosen(const Fixations& from, std::span<const std::uint32_t> indices) {
    Fixations found;
    for (const std::uint32_t i : indices)
        found.push_back(from[i]);
    return found;
}

/// Mean over random halves of both levels; CC at the full number of fixations.
Similarities ceiling_of(const Comparison& of, const FixationMaps& maps, const StudyOptions& options,
                        std::uint64_t stream) {
    std::array<double, Similarities::count> sums{};
    std::array<int, Similarities::count> counts{};
    for (const Fixations* level : {&of.a, &of.b}) {
        if (level->size() < 4)
            continue;
        for (int split = 0; split < options.splits; ++split) {
            const auto [first, second] =
                random_halves(static_cast<std::uint32_t>(level->size()), options.seed,
                              stream * 1000 + static_cast<std::uint64_t>(split) * 2 + (level == &of.b));
            const Similarities halves = similarities(maps.sum_of(chosen(*level, first)),
                                                     maps.sum_of(chosen(*level, second)), maps.areas());
            for (std::size_t i = 0; i < halves.values.size(); ++i) {
                if (halves.values[i]) {
                    sums[i] += *halves.values[i];
                    ++counts[i];
                }
            }
        }
    }
    Similarities ceiling;
    for (std::size_t i = 0; i < sums.size(); ++i) {
        if (counts[i] > 0)
            ceiling.values[i] = sums[i] / counts[i];
    }
    if (ceiling.values[0] && *ceiling.values[0] > 0.0)
        ceiling.values[0] = spearman_brown(*ceiling.values[0]);
    return ceiling;
}

void reckon(Comparison& of, const FixationMaps* maps, const SurfaceScale& scale, const StudyOptions& options,
            std::uint64_t stream, int permutations) {
    const auto wss = [](const Fixations& fixations) {
        std::vector<glm::dvec3> points;
        for (const StudyFixation* fixation : fixations)
            points.push_back(fixation->position);
        return point_spread(points)->wss();
    };
    const double mm2 = scale.mm_per_unit * scale.mm_per_unit;
    of.wss_difference_mm2 = (wss(of.a) - wss(of.b)) * mm2;
    of.wss_difference_deg2 = *of.wss_difference_mm2 / (scale.mm_per_deg * scale.mm_per_deg);
    if (!maps)
        return;
    const std::vector<double> all_of_a = maps->sum_of(of.a), all_of_b = maps->sum_of(of.b);
    of.found = similarities(all_of_a, all_of_b, maps->areas());
    of.ceiling = ceiling_of(of, *maps, options, stream);
    std::vector<double> both(all_of_a.size());
    for (std::size_t v = 0; v < both.size(); ++v)
        both[v] = all_of_a[v] + all_of_b[v];
    Fixations mixed = of.a;
    mixed.insert(mixed.end(), of.b.begin(), of.b.end());
    for (int permutation = 0; permutation < permutations; ++permutation) {
        RandomStream random(options.seed, "levels of fixations",
                            stream * 100000 + static_cast<std::uint64_t>(permutation));
        Fixations shuffled = mixed;
        random.shuffle(std::span(shuffled));
        shuffled.resize(of.a.size());
        const std::vector<double> first = maps->sum_of(shuffled);
        std::vector<double> second(both.size());
        for (std::size_t v = 0; v < both.size(); ++v)
            second[v] = std::max(both[v] - first[v], 0.0);
        of.permuted.push_back(similarities(first, second, maps->areas()));
    }
}

/// The mean of each observer's comparisons, of those that have a value.
template <class Value>
std::vector<double> observer_means(std::span<const Comparison> comparisons, const Value& value) {
    std::map<std::size_t, std::pair<double, int>> sums;
    for (const Comparison& comparison : comparisons) {
        if (const std::optional<double> number = value(comparison)) {
            sums[comparison.observer].first += *number;
            ++sums[comparison.observer].second;
        }
    }
    std::vector<double> means;
    for (const auto& [observer, sum] : sums)
        means.push_back(sum.first / sum.second);
    return means;
}

SimilarityEstimate similarity_of(std::span<const Comparison> comparisons, std::size_t which, int permutations,
                                 const StudyOptions& options) {
    SimilarityEstimate estimate;
    const std::string absent = "no observer has maps in both levels";
    const auto mean = [&](const auto& value) {
        return estimated_mean(observer_means(comparisons, value), options.bootstrap(), absent);
    };
    estimate.value = mean([&](const Comparison& of) { return of.found.values[which]; });
    estimate.ceiling = mean([&](const Comparison& of) { return of.ceiling.values[which]; });
    std::vector<double> permuted;
    for (int i = 0; i < permutations; ++i) {
        const std::vector<double> means = observer_means(comparisons, [&](const Comparison& of) {
            const auto index = static_cast<std::size_t>(i);
            return index < of.permuted.size() ? of.permuted[index].values[which] : std::nullopt;
        });
        double sum = 0.0;
        for (const double one : means)
            sum += one;
        if (!means.empty())
            permuted.push_back(sum / static_cast<double>(means.size()));
    }
    if (permuted.empty() || !estimate.value.value) {
        estimate.null = Estimate::none(absent);
        return estimate;
    }
    estimate.p = p_of_least(*estimate.value.value, permuted);
    double sum = 0.0;
    for (const double one : permuted)
        sum += one;
    std::sort(permuted.begin(), permuted.end());
    const double outside = 0.5 * (1.0 - options.confidence);
    estimate.null = Estimate::of(
        sum / static_cast<double>(permuted.size()),
        Interval{quantile_of_sorted(permuted, outside), quantile_of_sorted(permuted, 1.0 - outside)});
    return estimate;
}

/// Permutations of maps: each is a sum over vertices, so fewer than of numbers.
constexpr int most_map_permutations = 200;

} // namespace

std::vector<PairRow> study_pairs(const StudyResults& results, const std::vector<SculptureSurface>& surfaces,
                                 const SculptureFixationMaps& maps, const LevelLists& levels,
                                 const StudyOptions& options) {
    const std::vector<std::string> others = columns_beside_compared(options);
    const std::vector<std::string> compared = levels_of(results, options.compare, levels);
    const int permutations = std::min(options.permutations, most_map_permutations);
    std::vector<PairRow> rows;
    std::vector<std::pair<std::size_t, double>> tested;
    for (const StudyGroup& group : make_groups(results, others, levels)) {
        const auto observers = by_observer(results, group.trials);
        for (std::size_t a = 0; a < compared.size(); ++a) {
            for (std::size_t b = a + 1; b < compared.size(); ++b) {
                PairRow row;
                row.keys = group.keys;
                row.column = options.compare;
                row.a = compared[a];
                row.b = compared[b];
                std::vector<Comparison> comparisons;
                for (std::size_t o = 0; o < observers.size(); ++o) {
                    std::vector<int> in_a, in_b;
                    for (const int trial : observers[o].second) {
                        const std::string& level =
                            results.trials[static_cast<std::size_t>(trial)].key(options.compare);
                        if (level == row.a)
                            in_a.push_back(trial);
                        else if (level == row.b)
                            in_b.push_back(trial);
                    }
                    for (int sculpture = 0; sculpture < static_cast<int>(surfaces.size()); ++sculpture) {
                        Comparison one{o,
                                       sculpture,
                                       fixations_on(results, in_a, sculpture),
                                       fixations_on(results, in_b, sculpture),
                                       {},
                                       {},
                                       {},
                                       {},
                                       {}};
                        if (!one.a.empty() && !one.b.empty() &&
                            surfaces[static_cast<std::size_t>(sculpture)].scale)
                            comparisons.push_back(std::move(one));
                    }
                }
                const std::uint64_t stream = rows.size() * 10000;
                parallel_for(static_cast<int>(comparisons.size()), [&](int i) {
                    Comparison& one = comparisons[static_cast<std::size_t>(i)];
                    const auto sculpture = static_cast<std::size_t>(one.sculpture);
                    reckon(one, maps[sculpture].get(), *surfaces[sculpture].scale, options,
                           stream + static_cast<std::uint64_t>(i), permutations);
                });
                row.comparisons = static_cast<int>(comparisons.size());
                if (comparisons.empty())
                    row.absent = "no observer saw a sculpture in both levels";
                const std::vector<double> mm2 =
                    observer_means(comparisons, [](const Comparison& of) { return of.wss_difference_mm2; });
                row.observers = static_cast<int>(mm2.size());
                row.wss_difference_mm2 = estimated_mean(mm2, options.bootstrap(), row.absent);
                row.wss_difference_deg2 = estimated_mean(
                    observer_means(comparisons, [](const Comparison& of) { return of.wss_difference_deg2; }),
                    options.bootstrap(), row.absent);
                if (const auto test = sign_flip_test(mm2, options.permutation())) {
                    row.wss_p = test->p;
                    tested.emplace_back(rows.size(), test->p);
                }
                row.cc = similarity_of(comparisons, 0, permutations, options);
                row.sim_mit = similarity_of(comparisons, 1, permutations, options);
                row.sim_pysaliency = similarity_of(comparisons, 2, permutations, options);
                rows.push_back(std::move(row));
            }
        }
    }
    std::vector<double> p;
    for (const auto& [row, value] : tested)
        p.push_back(value);
    const std::vector<double> corrected = holm(p);
    for (std::size_t i = 0; i < tested.size(); ++i)
        rows[tested[i].first].wss_p_holm = corrected[i];
    return rows;
}

} // namespace overt
