#include "experiment/study/study_pairs.h"

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <numeric>
#include <utility>

#include "experiment/base/parallel.h"
#include "experiment/base/random.h"
#include "experiment/statistics/map_similarity.h"
#include "experiment/statistics/swap_test.h"
#include "experiment/study/level_comparisons.h"
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

/// A comparison, and what is reckoned of it.
struct Comparison : LevelComparison {
    std::optional<double> wss_difference_mm2, wss_difference_deg2;
    Similarities found, between_halves, within_halves;
    std::vector<Similarities> permuted;
    std::vector<double> map_a, map_b; ///< empty without maps
};

Fixations chosen(const Fixations& from, std::span<const std::uint32_t> indices) {
    Fixations found;
    for (const std::uint32_t i : indices)
        found.push_back(from[i]);
    return found;
}

/// Two draws of `count` fixations that have none in common, at random.
std::pair<Fixations, Fixations> two_draws(const Fixations& from, std::size_t count, RandomStream& random) {
    std::vector<std::uint32_t> all(from.size());
    std::iota(all.begin(), all.end(), 0u);
    random.shuffle(std::span(all));
    return {chosen(from, std::span(all).first(count)), chosen(from, std::span(all).subspan(count, count))};
}

/// A mean of each similarity, of those that there are.
class SimilarityMeans {
  public:
    void add(const Similarities& one) {
        for (std::size_t i = 0; i < one.values.size(); ++i) {
            if (one.values[i]) {
                sums_[i] += *one.values[i];
                ++counts_[i];
            }
        }
    }
    Similarities means() const {
        Similarities means;
        for (std::size_t i = 0; i < sums_.size(); ++i) {
            if (counts_[i] > 0)
                means.values[i] = sums_[i] / counts_[i];
        }
        return means;
    }

  private:
    std::array<double, Similarities::count> sums_{};
    std::array<int, Similarities::count> counts_{};
};

/// Random halves of both levels, each of half as many fixations as the level with fewer has: of both levels,
/// and of the same one.
void compare_halves(Comparison& of, const FixationMaps& maps, const StudyOptions& options,
                    std::uint64_t stream) {
    const std::size_t half = std::min(of.a.size(), of.b.size()) / 2;
    if (half < 2)
        return;
    SimilarityMeans between, within;
    for (int split = 0; split < options.splits; ++split) {
        RandomStream random(options.seed, "halves of levels",
                            stream * 1000 + static_cast<std::uint64_t>(split));
        const auto map_of = [&](const Fixations& fixations) { return maps.sum_of(fixations); };
        const auto [a_first, a_second] = two_draws(of.a, half, random);
        const auto [b_first, b_second] = two_draws(of.b, half, random);
        const std::vector<double> a1 = map_of(a_first), a2 = map_of(a_second), b1 = map_of(b_first),
                                  b2 = map_of(b_second);
        within.add(similarities(a1, a2, maps.areas()));
        within.add(similarities(b1, b2, maps.areas()));
        between.add(similarities(a1, b1, maps.areas()));
        between.add(similarities(a2, b2, maps.areas()));
    }
    of.between_halves = between.means();
    of.within_halves = within.means();
}

void reckon(Comparison& of, const FixationMaps* maps, const ObjectScale& scale, const StudyOptions& options,
            std::uint64_t stream, int permutations) {
    of.wss_difference_mm2 = wss_difference_mm2(of, scale);
    of.wss_difference_deg2 = wss_difference_deg2(of, scale);
    if (!maps)
        return;
    of.map_a = maps->sum_of(of.a);
    of.map_b = maps->sum_of(of.b);
    of.found = similarities(of.map_a, of.map_b, maps->areas());
    compare_halves(of, *maps, options, stream);
    std::vector<double> both(of.map_a.size());
    for (std::size_t v = 0; v < both.size(); ++v)
        both[v] = of.map_a[v] + of.map_b[v];
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

SimilarityEstimate similarity_of(std::span<const Comparison> comparisons, std::size_t which, int permutations,
                                 const StudyOptions& options) {
    SimilarityEstimate estimate;
    const std::string absent = "no observer has maps in both levels";
    const auto mean = [&](const auto& value) {
        return estimated_mean(observer_means(comparisons, value), options.bootstrap(), absent);
    };
    estimate.value = mean([&](const Comparison& of) { return of.found.values[which]; });
    const std::string too_few = "no observer has four fixations in both levels";
    const auto mean_of_halves = [&](Similarities Comparison::*halves) {
        return estimated_mean(
            observer_means(comparisons, [&](const Comparison& of) { return (of.*halves).values[which]; }),
            options.bootstrap(), too_few);
    };
    estimate.between_halves = mean_of_halves(&Comparison::between_halves);
    estimate.within_halves = mean_of_halves(&Comparison::within_halves);
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

/// Numbers of a row from its comparisons, all but the keys.
PairRow row_of(std::span<const Comparison> comparisons, int permutations, const StudyOptions& options) {
    PairRow row;
    row.comparisons = static_cast<int>(comparisons.size());
    if (comparisons.empty())
        row.absent = "no observer saw an object in both levels";
    const auto means = [&](const auto& value) { return observer_means(comparisons, value); };
    const std::vector<double> deg2 = means([](const Comparison& of) { return of.wss_difference_deg2; });
    row.observers = static_cast<int>(deg2.size());
    row.wss_difference_mm2 = estimated_mean(means([](const Comparison& of) { return of.wss_difference_mm2; }),
                                            options.bootstrap(), row.absent);
    row.wss_difference_deg2 = estimated_mean(deg2, options.bootstrap(), row.absent);
    // As they are seen: a large object would weigh more than a small one that looks as large.
    if (const auto test = sign_flip_test(deg2, options.permutation()))
        row.wss_p = test->p;
    row.cc = similarity_of(comparisons, 0, permutations, options);
    row.sim_mit = similarity_of(comparisons, 1, permutations, options);
    row.sim_pysaliency = similarity_of(comparisons, 2, permutations, options);
    return row;
}

/// The test of the maps themselves. `cells`: comparisons of one group each.
void test_maps(PairRow& row, std::span<const std::span<const Comparison>> cells,
               const ObjectFixationMaps& maps, const StudyOptions& options) {
    std::vector<PairedMaps> surfaces;
    std::size_t observers = 0;
    for (const std::span<const Comparison> cell : cells) {
        for (std::size_t object = 0; object < maps.size(); ++object) {
            if (!maps[object])
                continue;
            PairedMaps paired(maps[object]->areas());
            for (const Comparison& one : cell) {
                if (static_cast<std::size_t>(one.object) == object) {
                    paired.add(one.observer, one.map_a, one.map_b);
                    observers = std::max(observers, one.observer + 1);
                }
            }
            if (!paired.observers().empty())
                surfaces.push_back(std::move(paired));
        }
    }
    if (const auto test = swap_test(surfaces, observers, options.permutation())) {
        row.maps_cc = test->correlation;
        row.maps_p = test->test.p;
    }
}

/// After Holm, rows of groups among themselves and those over all groups among themselves.
void correct(std::vector<PairRow>& rows, std::optional<double> PairRow::*p,
             std::optional<double> PairRow::*corrected) {
    for (const bool of_groups : {false, true}) {
        std::vector<double> tested;
        std::vector<PairRow*> own;
        for (PairRow& row : rows) {
            if (row.keys.empty() != of_groups && row.*p) {
                tested.push_back(*(row.*p));
                own.push_back(&row);
            }
        }
        const std::vector<double> after = holm(tested);
        for (std::size_t i = 0; i < own.size(); ++i)
            own[i]->*corrected = after[i];
    }
}

} // namespace

std::vector<PairRow> study_pairs(const StudyResults& results, const std::vector<ObjectSurface>& surfaces,
                                 const ObjectFixationMaps& maps, const LevelLists& levels,
                                 const StudyOptions& options) {
    const std::vector<std::string> others = columns_beside_compared(options);
    const std::vector<std::string> compared = levels_of(results, options.compare, levels);
    const std::vector<StudyGroup> groups = make_groups(results, others, levels);
    const int permutations = std::min(options.permutations, most_map_permutations);
    std::vector<PairRow> rows;
    std::vector<std::vector<std::vector<Comparison>>> of_pair; ///< by pair of levels and group
    for (const StudyGroup& group : groups) {
        std::size_t pair = 0;
        for (std::size_t a = 0; a < compared.size(); ++a) {
            for (std::size_t b = a + 1; b < compared.size(); ++b, ++pair) {
                std::vector<Comparison> comparisons;
                for (LevelComparison& one : level_comparisons(results, group.trials, surfaces,
                                                              options.compare, compared[a], compared[b]))
                    comparisons.push_back({std::move(one), {}, {}, {}, {}, {}, {}, {}, {}});
                const std::uint64_t stream = rows.size() * 10000;
                parallel_for(static_cast<int>(comparisons.size()), [&](int i) {
                    Comparison& one = comparisons[static_cast<std::size_t>(i)];
                    const auto object = static_cast<std::size_t>(one.object);
                    reckon(one, maps[object].get(), *surfaces[object].scale, options,
                           stream + static_cast<std::uint64_t>(i), permutations);
                });
                PairRow row = row_of(comparisons, permutations, options);
                row.keys = group.keys;
                row.column = options.compare;
                row.a = compared[a];
                row.b = compared[b];
                test_maps(row, std::array{std::span<const Comparison>(comparisons)}, maps, options);
                rows.push_back(std::move(row));
                if (of_pair.size() <= pair)
                    of_pair.emplace_back();
                of_pair[pair].push_back(std::move(comparisons));
            }
        }
    }
    // Over all groups: compared within each, so that what the groups tell apart cannot pass for a difference.
    for (std::size_t pair = 0; groups.size() > 1 && pair < of_pair.size(); ++pair) {
        std::vector<Comparison> all;
        for (const std::vector<Comparison>& cell : of_pair[pair])
            all.insert(all.end(), cell.begin(), cell.end());
        PairRow row = row_of(all, permutations, options);
        row.column = rows[pair].column;
        row.a = rows[pair].a;
        row.b = rows[pair].b;
        const std::vector<std::span<const Comparison>> cells(of_pair[pair].begin(), of_pair[pair].end());
        test_maps(row, cells, maps, options);
        rows.push_back(std::move(row));
    }
    correct(rows, &PairRow::wss_p, &PairRow::wss_p_holm);
    correct(rows, &PairRow::maps_p, &PairRow::maps_p_holm);
    return rows;
}

} // namespace overt
