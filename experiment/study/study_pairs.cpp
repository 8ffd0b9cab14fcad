#include "experiment/study/study_pairs.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <memory>
#include <numeric>
#include <utility>

#include "experiment/base/parallel.h"
#include "experiment/base/random.h"
#include "experiment/statistics/swap_test.h"
#include "experiment/study/level_comparisons.h"
#include "experiment/study/observer_similarities.h"
#include "experiment/study/study_maps.h"

namespace overt {

namespace {

constexpr std::array<SimilarityEstimate PairRow::*, Similarities::count> similarity_members{
    &PairRow::cc, &PairRow::sim_mit, &PairRow::sim_pysaliency};

/// A comparison, and what is reckoned of it.
struct Comparison : LevelComparison {
    std::optional<double> wss_difference_mm2, wss_difference_deg2;
    Similarities found;
    std::vector<Similarities> permuted; ///< of whole trials dealt out again; empty if that changes nothing
    std::vector<double> map_a, map_b;   ///< empty without maps
    std::vector<double> like_a, like_b; ///< the same of as many fixations of either level
};

/// As many of them at random.
Fixations some_of(const Fixations& from, std::size_t count, RandomStream& random) {
    Fixations some = from;
    if (count < from.size()) {
        random.shuffle(std::span(some));
        some.resize(count);
    }
    return some;
}

/// Fixations by the trial that they are of.
std::vector<Fixations> fixations_by_trial(const Fixations& fixations) {
    std::map<int, Fixations> trials;
    for (const StudyFixation* fixation : fixations)
        trials[fixation->trial].push_back(fixation);
    std::vector<Fixations> found;
    for (auto& [trial, own] : trials)
        found.push_back(std::move(own));
    return found;
}

/// Deals the trials of both levels out again.
void deal_out_trials(Comparison& of, const FixationMaps& maps, const StudyOptions& options,
                     std::uint64_t stream, int permutations) {
    std::vector<std::vector<double>> of_trials;
    std::vector<Fixations> trials = fixations_by_trial(of.a);
    const std::size_t in_a = trials.size();
    std::ranges::move(fixations_by_trial(of.b), std::back_inserter(trials));
    if (trials.size() < 3)
        return; // of one trial of each level the other way round is the same
    std::vector<std::size_t> order(trials.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    for (const Fixations& own : trials)
        of_trials.push_back(maps.sum_of(own));
    for (int permutation = 0; permutation < permutations; ++permutation) {
        RandomStream random(options.seed, "levels of trials",
                            stream * 100000 + static_cast<std::uint64_t>(permutation));
        std::vector<std::size_t> shuffled = order;
        random.shuffle(std::span(shuffled));
        std::vector<double> sums[2] = {std::vector<double>(of.map_a.size(), 0.0),
                                       std::vector<double>(of.map_a.size(), 0.0)};
        for (std::size_t i = 0; i < shuffled.size(); ++i) {
            std::vector<double>& sum = sums[i < in_a ? 0 : 1];
            const std::vector<double>& own = of_trials[shuffled[i]];
            for (std::size_t v = 0; v < sum.size(); ++v)
                sum[v] += own[v];
        }
        of.permuted.push_back(similarities(sums[0], sums[1], maps.visible_areas()));
    }
}

void reckon(Comparison& of, const FixationMaps* maps, const ObjectScale& scale, const StudyOptions& options,
            std::uint64_t stream, int permutations) {
    of.wss_difference_mm2 = wss_difference_mm2(of, scale);
    of.wss_difference_deg2 = wss_difference_deg2(of, scale);
    if (!maps)
        return;
    of.map_a = maps->sum_of(of.a);
    of.map_b = maps->sum_of(of.b);
    of.found = similarities(of.map_a, of.map_b, maps->visible_areas());
    RandomStream random(options.seed, "as many of either level", stream);
    const std::size_t fewer = std::min(of.a.size(), of.b.size());
    of.like_a = maps->sum_of(some_of(of.a, fewer, random));
    of.like_b = maps->sum_of(some_of(of.b, fewer, random));
    deal_out_trials(of, *maps, options, stream, permutations);
}

SimilarityEstimate similarity_of(std::span<const Comparison> comparisons, std::size_t which, int permutations,
                                 const StudyOptions& options) {
    SimilarityEstimate estimate;
    const std::string absent = "no observer has maps in both levels";
    estimate.value =
        within(estimated_mean(
                   observer_means(comparisons, [&](const Comparison& of) { return of.found.values[which]; }),
                   options.bootstrap(), absent),
               least_similarity(which));
    if (!estimate.value.value) {
        estimate.null = Estimate::none(absent);
        return estimate;
    }
    if (std::ranges::all_of(comparisons, [](const Comparison& of) { return of.permuted.empty(); })) {
        estimate.null = Estimate::none("one trial of each level: there is nothing to be dealt out again");
        return estimate;
    }
    std::vector<double> permuted;
    for (int i = 0; i < permutations; ++i) {
        const std::vector<double> means = observer_means(comparisons, [&](const Comparison& of) {
            return of.permuted.empty() ? of.found.values[which]
                                       : of.permuted[static_cast<std::size_t>(i)].values[which];
        });
        if (!means.empty())
            permuted.push_back(std::accumulate(means.begin(), means.end(), 0.0) /
                               static_cast<double>(means.size()));
    }
    estimate.p = p_of_least(*estimate.value.value, permuted);
    const double mean =
        std::accumulate(permuted.begin(), permuted.end(), 0.0) / static_cast<double>(permuted.size());
    std::sort(permuted.begin(), permuted.end());
    const double outside = 0.5 * (1.0 - options.confidence);
    estimate.null = Estimate::of(
        mean, Interval{quantile_of_sorted(permuted, outside), quantile_of_sorted(permuted, 1.0 - outside)});
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
    const std::string absent =
        comparisons.empty() ? row.absent : "no observer has two fixations on an object in both levels";
    row.wss_difference_mm2 = estimated_mean(means([](const Comparison& of) { return of.wss_difference_mm2; }),
                                            options.bootstrap(), absent);
    row.wss_difference_deg2 = estimated_mean(deg2, options.bootstrap(), absent);
    // As they are seen: a large object would weigh more than a small one that looks as large.
    if (const auto test = sign_flip_test(deg2, options.permutation()))
        row.wss_p = test->p;
    row.wss_evidence = options.evidence(deg2);
    for (std::size_t which = 0; which < Similarities::count; ++which)
        row.*similarity_members[which] = similarity_of(comparisons, which, permutations, options);
    return row;
}

/// The similarities of maps of two observers. `cells`: comparisons of one group each.
void compare_observers(PairRow& row, std::span<const std::span<const Comparison>> cells,
                       const ObjectFixationMaps& maps, const StudyOptions& options) {
    std::size_t observers = 0;
    std::vector<LikeMaps> all;
    for (std::size_t cell = 0; cell < cells.size(); ++cell) {
        for (const Comparison& one : cells[cell]) {
            const auto& own = maps[static_cast<std::size_t>(one.object)];
            if (own)
                all.push_back({one.observer, cell, one.object, one.like_a, one.like_b, own->visible_areas()});
            observers = std::max(observers, one.observer + 1);
        }
    }
    const std::array<ObserverSimilarities, Similarities::count> found =
        observer_similarities(all, observers, options.confidence);
    for (std::size_t which = 0; which < Similarities::count; ++which) {
        SimilarityEstimate& own = row.*similarity_members[which];
        own.other_level = within(found[which].other_level, least_similarity(which));
        own.same_level = within(found[which].same_level, least_similarity(which));
        own.level_effect = found[which].difference;
    }
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
            PairedMaps paired(maps[object]->visible_areas());
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
                const std::array cells{std::span<const Comparison>(comparisons)};
                test_maps(row, cells, maps, options);
                compare_observers(row, cells, maps, options);
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
        compare_observers(row, cells, maps, options);
        rows.push_back(std::move(row));
    }
    correct(rows, &PairRow::wss_p, &PairRow::wss_p_holm);
    correct(rows, &PairRow::maps_p, &PairRow::maps_p_holm);
    return rows;
}

} // namespace overt
