/// Two levels of a factor within observers: what of a study is compared, and the differences that are tested.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "experiment/study/read/study_reader.h"
#include "experiment/study/results/study_groups.h"

namespace overt {

/// One observer's counted fixations on one object in both levels; what else the groups tell apart is the
/// same in both.
struct LevelComparison {
    std::size_t observer = 0; ///< by the order of by_observer() of all trials
    int object = 0;
    std::vector<const StudyFixation*> a, b; ///< neither empty
};

/// Those of one group of trials, by observer and object. Objects without a scale are left out.
std::vector<LevelComparison> level_comparisons(const StudyResults& results, const std::vector<int>& trials,
                                               const std::vector<ObjectSurface>& surfaces,
                                               const std::string& column, const std::string& a,
                                               const std::string& b);

/// WSS of a less that of b, both unbiased (unbiased_wss), since the levels may have unequal numbers of
/// fixations: on the object, and as it is seen in the depth of the object's axis. What is averaged over
/// objects is tested as it is seen. Nothing if either level has one fixation alone.
std::optional<double> wss_difference_mm2(const LevelComparison& comparison, const ObjectScale& scale);
std::optional<double> wss_difference_deg2(const LevelComparison& comparison, const ObjectScale& scale);

/// Share of the fixations on an area, of a less that of b; nothing if the object does not have it.
std::optional<double> area_difference(const LevelComparison& comparison, const StudyResults& results,
                                      std::string_view area);

/// The mean of each observer's comparisons, of those that have a value: what tests over observers take. By
/// observer, without those who have none.
template <class Comparison, class Value>
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

} // namespace overt
