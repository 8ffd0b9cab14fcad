#include "experiment/statistics/area_under_curve.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "experiment/base/random.h"

namespace overt {

namespace {

/// By how much values may differ that ought to be the same.
double rounding_of(double most, double least) { return 1e-12 * std::max(std::abs(most), std::abs(least)); }

} // namespace

std::optional<double> auc_judd(std::span<const double> map, std::span<const double> areas,
                               std::span<const double> at_fixations) {
    std::vector<std::pair<double, double>> falling; // value and area of each place
    double area = 0.0;
    for (std::size_t i = 0; i < map.size(); ++i) {
        if (areas[i] > 0.0) {
            falling.emplace_back(map[i], areas[i]);
            area += areas[i];
        }
    }
    const auto places = static_cast<double>(falling.size());
    const auto fixations = static_cast<double>(at_fixations.size());
    if (at_fixations.empty() || !(places > fixations))
        return std::nullopt;
    const double mean_area = area / places;
    std::sort(falling.begin(), falling.end(), [](auto& a, auto& b) { return a.first > b.first; });
    std::vector<double> thresholds(at_fixations.begin(), at_fixations.end());
    std::sort(thresholds.begin(), thresholds.end(), std::greater<>());

    // Between places a value is reckoned from several, and may be off by rounding.
    const double rounding = rounding_of(falling.front().first, falling.back().first);
    double above = 0.0, sum = 0.0, hits = 0.0, alarms = 0.0;
    std::size_t next = 0;
    for (std::size_t i = 0; i < thresholds.size(); ++i) {
        // Fixations where the map is as high are reached together.
        if (i + 1 < thresholds.size() && thresholds[i] - thresholds[i + 1] <= rounding)
            continue;
        for (; next < falling.size() && falling[next].first >= thresholds[i] - rounding; ++next)
            above += falling[next].second;
        const auto rank = static_cast<double>(i + 1);
        // On unequal areas fixations can take more than there is.
        const double new_alarms = std::clamp((above / mean_area - rank) / (places - fixations), alarms, 1.0);
        const double new_hits = rank / fixations;
        sum += 0.5 * (new_alarms - alarms) * (hits + new_hits);
        alarms = new_alarms;
        hits = new_hits;
    }
    return sum + 0.5 * (1.0 - alarms) * (hits + 1.0);
}

double auc_by_steps(std::span<const double> at_fixations, std::span<const double> at_random, double step) {
    const auto share_from = [](std::span<const double> values, double threshold) {
        return static_cast<double>(std::count_if(values.begin(), values.end(),
                                                 [&](double value) { return value >= threshold; })) /
               static_cast<double>(values.size());
    };
    double most = 0.0;
    for (const double value : at_fixations)
        most = std::max(most, value);
    for (const double value : at_random)
        most = std::max(most, value);
    // MATLAB's 0:step:most ends at the last multiple within rounding.
    const int last = static_cast<int>(most / step + 1e-10);
    double sum = 0.0, hits = 0.0, alarms = 0.0;
    for (int i = last; i >= 0; --i) {
        const double threshold = i * step;
        const double new_hits = share_from(at_fixations, threshold),
                     new_alarms = share_from(at_random, threshold);
        sum += 0.5 * (new_alarms - alarms) * (hits + new_hits);
        hits = new_hits;
        alarms = new_alarms;
    }
    return sum + 0.5 * (1.0 - alarms) * (hits + 1.0);
}

std::optional<double> auc_borji(std::span<const double> map, std::span<const double> areas,
                                std::span<const double> at_fixations, std::uint64_t seed, int splits,
                                double step) {
    double least = std::numeric_limits<double>::infinity(), most = -least;
    std::vector<double> up_to(areas.size());
    std::partial_sum(areas.begin(), areas.end(), up_to.begin());
    for (std::size_t i = 0; i < map.size(); ++i) {
        if (areas[i] > 0.0) {
            least = std::min(least, map[i]);
            most = std::max(most, map[i]);
        }
    }
    if (at_fixations.empty() || !(most - least > rounding_of(most, least)))
        return std::nullopt;
    const auto scaled = [&](double value) { return (value - least) / (most - least); };
    std::vector<double> fixated, random_values(at_fixations.size());
    std::transform(at_fixations.begin(), at_fixations.end(), std::back_inserter(fixated), scaled);
    double sum = 0.0;
    for (int split = 0; split < splits; ++split) {
        RandomStream random(seed, "AUC-Borji", static_cast<std::uint64_t>(split));
        for (double& value : random_values) {
            const double place = random.uniform() * up_to.back();
            const auto found = std::upper_bound(up_to.begin(), up_to.end(), place);
            const auto index = std::min(static_cast<std::size_t>(found - up_to.begin()), map.size() - 1);
            value = scaled(map[index]);
        }
        sum += auc_by_steps(fixated, random_values, step);
    }
    return sum / splits;
}

} // namespace overt
