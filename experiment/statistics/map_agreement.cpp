#include "experiment/statistics/map_agreement.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "experiment/statistics/distributions.h"
#include "experiment/statistics/map_similarity.h"

namespace overt {

namespace {

/// Covariances over the surface of each two maps, row by row.
std::vector<double> covariances_of(std::span<const std::vector<double>> maps, std::span<const double> areas) {
    double area = 0.0;
    for (const double one : areas)
        area += one;
    std::vector<std::vector<double>> centred;
    for (const std::vector<double>& map : maps) {
        const double mean = area > 0.0 ? integral(map, areas) / area : 0.0;
        std::vector<double>& own = centred.emplace_back(map);
        for (double& value : own)
            value -= mean;
    }
    std::vector<double> covariances(maps.size() * maps.size());
    for (std::size_t i = 0; i < maps.size(); ++i) {
        for (std::size_t j = 0; j <= i; ++j) {
            double sum = 0.0;
            for (std::size_t v = 0; v < areas.size(); ++v)
                sum += areas[v] * centred[i][v] * centred[j][v];
            covariances[i * maps.size() + j] = covariances[j * maps.size() + i] = sum;
        }
    }
    return covariances;
}

/// Of all observers but one; `left_out` = count: of all.
std::optional<double> alpha_of(const std::vector<double>& covariances, std::size_t count,
                               std::size_t left_out) {
    double all = 0.0, own = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t j = 0; j < count; ++j) {
            if (i == left_out || j == left_out)
                continue;
            all += covariances[i * count + j];
            own += i == j ? covariances[i * count + j] : 0.0;
        }
    }
    const double n = static_cast<double>(left_out < count ? count - 1 : count);
    // What rounding leaves of a constant sum is nothing.
    if (!(all > 1e-12 * own) || n < 2.0)
        return std::nullopt;
    return n / (n - 1.0) * (1.0 - own / all);
}

double fisher_z(double value) { return std::atanh(std::clamp(value, -0.999999, 0.999999)); }

} // namespace

MapAgreement map_agreement(std::span<const std::vector<double>> of_observers, std::span<const double> areas,
                           double confidence) {
    MapAgreement found;
    const std::size_t count = of_observers.size();
    const std::vector<double> covariances = covariances_of(of_observers, areas);
    const std::optional<double> alpha = alpha_of(covariances, count, count);
    if (!alpha) {
        found.reliability = found.of_halves =
            Estimate::none(count < 2 ? "halves need two observers with fixations" : "the maps are constant");
        return found;
    }
    found.reliability = Estimate::of(*alpha);
    found.of_halves = Estimate::of(*alpha / (2.0 - *alpha));
    std::vector<double> without;
    for (std::size_t left_out = 0; left_out < count && count >= 3; ++left_out) {
        if (const std::optional<double> one = alpha_of(covariances, count, left_out))
            without.push_back(fisher_z(*one));
    }
    if (without.size() < 3 || without.size() < count)
        return found;
    const auto n = static_cast<double>(count);
    double mean = 0.0, squares = 0.0;
    for (const double z : without)
        mean += z / n;
    for (const double z : without)
        squares += (z - mean) * (z - mean);
    const double reach =
        student_quantile(0.5 * (1.0 + confidence), n - 1.0) * std::sqrt((n - 1.0) / n * squares);
    found.reliability.interval =
        Interval{std::tanh(fisher_z(*alpha) - reach), std::tanh(fisher_z(*alpha) + reach)};
    return found;
}

} // namespace overt
