#include "experiment/study/observer_similarities.h"

#include <algorithm>
#include <utility>

#include "experiment/base/parallel.h"
#include "experiment/statistics/map_similarity.h"
#include "experiment/statistics/pairwise_mean.h"

namespace overt {

namespace {

/// What two observers give.
struct PairOfObservers {
    std::size_t first = 0, second = 0; ///< of the maps
    Similarities other_level[2], same_level[2];
};

/// The mean of both, if there are both.
std::optional<double> mean_of_both(const Similarities (&both)[2], std::size_t which) {
    if (!both[0].values[which] || !both[1].values[which])
        return std::nullopt;
    return 0.5 * (*both[0].values[which] + *both[1].values[which]);
}

} // namespace

Similarities similarities(std::span<const double> a, std::span<const double> b,
                          std::span<const double> areas) {
    return {{correlation(a, b, areas), similarity(a, b, areas, SimConvention::mit),
             similarity(a, b, areas, SimConvention::pysaliency)}};
}

Estimate within(Estimate estimate, double least) {
    if (estimate.interval)
        estimate.interval = Interval{std::clamp(estimate.interval->low, least, 1.0),
                                     std::clamp(estimate.interval->high, least, 1.0)};
    return estimate;
}

std::array<ObserverSimilarities, Similarities::count>
observer_similarities(std::span<const LikeMaps> maps, std::size_t observers, double confidence) {
    std::vector<PairOfObservers> pairs;
    for (std::size_t i = 0; i < maps.size(); ++i) {
        for (std::size_t j = i + 1; j < maps.size(); ++j) {
            if (maps[i].cell == maps[j].cell && maps[i].object == maps[j].object &&
                maps[i].observer != maps[j].observer)
                pairs.push_back({i, j, {}, {}});
        }
    }
    parallel_for(static_cast<int>(pairs.size()), [&](int pair) {
        PairOfObservers& of = pairs[static_cast<std::size_t>(pair)];
        const LikeMaps &one = maps[of.first], &other = maps[of.second];
        of.other_level[0] = similarities(one.a, other.b, one.areas);
        of.other_level[1] = similarities(one.b, other.a, one.areas);
        of.same_level[0] = similarities(one.a, other.a, one.areas);
        of.same_level[1] = similarities(one.b, other.b, one.areas);
    });
    std::array<ObserverSimilarities, Similarities::count> found;
    for (std::size_t which = 0; which < Similarities::count; ++which) {
        PairwiseMean other_level(observers), same_level(observers), difference(observers);
        for (const PairOfObservers& of : pairs) {
            const std::size_t a = maps[of.first].observer, b = maps[of.second].observer;
            const std::optional<double> other = mean_of_both(of.other_level, which),
                                        same = mean_of_both(of.same_level, which);
            if (!other || !same)
                continue;
            other_level.add(a, b, *other);
            same_level.add(a, b, *same);
            difference.add(a, b, *same - *other);
        }
        const char* absent = "no two observers have maps of both levels on one object";
        found[which] = {other_level.estimate(confidence, absent), same_level.estimate(confidence, absent),
                        difference.estimate(confidence, absent)};
    }
    return found;
}

} // namespace overt
