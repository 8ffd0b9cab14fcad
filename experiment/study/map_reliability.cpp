#include "experiment/study/map_reliability.h"

#include <algorithm>
#include <cmath>

#include "experiment/base/parallel.h"
#include "experiment/statistics/distributions.h"
#include "experiment/statistics/map_similarity.h"
#include "experiment/statistics/split_half.h"
#include "experiment/study/study_maps.h"

namespace overt {

namespace {

/// Mean over random halves of these observers.
std::optional<double> correlation_of_halves(std::span<const std::vector<double>* const> maps,
                                            std::span<const double> areas, int splits, std::uint64_t seed) {
    double sum = 0.0;
    int count = 0;
    for (int split = 0; split < splits; ++split) {
        const auto [first, second] =
            random_halves(static_cast<std::uint32_t>(maps.size()), seed, static_cast<std::uint64_t>(split));
        const auto sum_of = [&](std::span<const std::uint32_t> half) {
            std::vector<double> all(areas.size(), 0.0);
            for (const std::uint32_t i : half) {
                for (std::size_t v = 0; v < all.size(); ++v)
                    all[v] += (*maps[i])[v];
            }
            return all;
        };
        if (const auto r = correlation(sum_of(first), sum_of(second), areas)) {
            sum += *r;
            ++count;
        }
    }
    return count > 0 ? std::optional(sum / count) : std::nullopt;
}

} // namespace

SplitHalf split_half_of(std::span<const std::vector<double>> of_observers, std::span<const double> areas,
                        int splits, double confidence, std::uint64_t seed) {
    SplitHalf found;
    std::vector<const std::vector<double>*> all;
    for (const std::vector<double>& one : of_observers)
        all.push_back(&one);
    const std::optional<double> r =
        all.size() < 2 ? std::nullopt : correlation_of_halves(all, areas, splits, seed);
    if (!r) {
        found.correlation = found.reliability = Estimate::none(
            all.size() < 2 ? "halves need two observers with fixations" : "the maps are constant");
        return found;
    }
    found.correlation = Estimate::of(*r);
    const double reliability = spearman_brown(*r);
    found.reliability = Estimate::of(reliability);
    const auto z_of = [](double value) { return std::atanh(std::clamp(value, -0.999999, 0.999999)); };
    std::vector<double> without;
    for (std::size_t left_out = 0; left_out < all.size() && all.size() >= 3; ++left_out) {
        std::vector<const std::vector<double>*> rest = all;
        rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(left_out));
        if (const auto r_without = correlation_of_halves(rest, areas, splits, seed))
            without.push_back(z_of(spearman_brown(*r_without)));
    }
    if (without.size() < 3 || without.size() < all.size())
        return found;
    const auto n = static_cast<double>(without.size());
    double mean = 0.0, squares = 0.0;
    for (const double z : without)
        mean += z / n;
    for (const double z : without)
        squares += (z - mean) * (z - mean);
    const double error = std::sqrt((n - 1.0) / n * squares);
    const double reach = student_quantile(0.5 * (1.0 + confidence), n - 1.0) * error;
    found.reliability.interval =
        Interval{std::tanh(z_of(reliability) - reach), std::tanh(z_of(reliability) + reach)};
    return found;
}

std::vector<MapReliabilityRow> map_reliabilities(const StudyResults& results, const ObjectFixationMaps& maps,
                                                 const LevelLists& levels, const StudyOptions& options) {
    std::vector<StudyGroup> groups = results.groups;
    std::vector<std::string> columns;
    for (const std::string& column : options.by) {
        if (column != "object")
            columns.push_back(column);
    }
    if (columns.size() > 1) {
        for (const std::string& column : columns)
            std::ranges::copy(make_groups(results, {column}, levels), std::back_inserter(groups));
    }
    if (!columns.empty())
        std::ranges::copy(make_groups(results, {}, levels), std::back_inserter(groups));

    std::vector<MapReliabilityRow> rows;
    std::vector<const StudyGroup*> group_of_row;
    for (const StudyGroup& group : groups) {
        for (const int object : objects_of(results, group)) {
            if (!maps[static_cast<std::size_t>(object)])
                continue;
            MapReliabilityRow& row = rows.emplace_back();
            row.keys = group.keys;
            row.object = object;
            group_of_row.push_back(&group);
        }
    }
    parallel_for(static_cast<int>(rows.size()), [&](int i) {
        MapReliabilityRow& row = rows[static_cast<std::size_t>(i)];
        const FixationMaps& own = *maps[static_cast<std::size_t>(row.object)];
        std::vector<std::vector<double>> of_observers;
        for (const auto& [observer, trials] :
             by_observer(results, group_of_row[static_cast<std::size_t>(i)]->trials)) {
            const Fixations fixations = fixations_on(results, trials, row.object);
            if (fixations.empty())
                continue;
            row.fixations += static_cast<int>(fixations.size());
            of_observers.push_back(own.sum_of(fixations));
        }
        row.observers = static_cast<int>(of_observers.size());
        const SplitHalf halves = split_half_of(of_observers, own.visible_areas(), options.splits,
                                               options.confidence, options.seed);
        row.split_half_cc = halves.correlation;
        row.reliability = halves.reliability;
    });
    return rows;
}

} // namespace overt
