#include "experiment/statistics/scanpath_measures.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace overt {

namespace {

/// Which fixation holds in each bin.
std::vector<std::size_t> in_bins(std::span<const double> durations, double bin_s) {
    std::vector<std::size_t> bins;
    for (std::size_t i = 0; i < durations.size(); ++i)
        bins.insert(bins.end(), static_cast<std::size_t>(std::max(1.0, std::round(durations[i] / bin_s))), i);
    return bins;
}

double vector_difference(const GazeStep& a, const GazeStep& b) {
    return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
}

/// 0 … pi; 0 where either has no length.
double angle_between(const GazeStep& a, const GazeStep& b) {
    const double lengths = std::hypot(a.x, a.y, a.z) * std::hypot(b.x, b.y, b.z);
    if (!(lengths > 0.0))
        return 0.0;
    return std::acos(std::clamp((a.x * b.x + a.y * b.y + a.z * b.z) / lengths, -1.0, 1.0));
}

double median_of(std::vector<double> values) {
    std::ranges::sort(values);
    const std::size_t middle = values.size() / 2;
    return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

/// The pairs of steps on the shortest path from the first of both to the last of both: of each step to a pair
/// the pair's own difference is to be paid.
std::vector<std::pair<std::size_t, std::size_t>> aligned_steps(std::span<const GazeStep> a,
                                                               std::span<const GazeStep> b) {
    const std::size_t columns = b.size();
    std::vector<double> cost(a.size() * columns);
    for (std::size_t i = 0; i < a.size(); ++i) {
        for (std::size_t j = 0; j < columns; ++j) {
            double before = i == 0 && j == 0 ? 0.0 : 1e300;
            if (i > 0 && j > 0)
                before = std::min(before, cost[(i - 1) * columns + j - 1]);
            if (i > 0)
                before = std::min(before, cost[(i - 1) * columns + j]);
            if (j > 0)
                before = std::min(before, cost[i * columns + j - 1]);
            cost[i * columns + j] = before + vector_difference(a[i], b[j]);
        }
    }
    std::vector<std::pair<std::size_t, std::size_t>> path;
    std::size_t i = a.size() - 1, j = columns - 1;
    while (true) {
        path.emplace_back(i, j);
        if (i == 0 && j == 0)
            return path;
        const double across = i > 0 && j > 0 ? cost[(i - 1) * columns + j - 1] : 1e301,
                     down = i > 0 ? cost[(i - 1) * columns + j] : 1e301,
                     right = j > 0 ? cost[i * columns + j - 1] : 1e301;
        if (across <= down && across <= right) {
            --i;
            --j;
        } else if (down <= right) {
            --i;
        } else {
            --j;
        }
    }
}

} // namespace

std::optional<Recurrence> recurrence(std::size_t count,
                                     const std::function<bool(std::size_t, std::size_t)>& is_near) {
    if (count < 2)
        return std::nullopt;
    std::vector<char> near(count * count, 0);
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t j = i + 1; j < count; ++j)
            near[i * count + j] = is_near(i, j);
    }
    double pairs = 0.0, repeated = 0.0, distances = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t j = i + 1; j < count; ++j) {
            if (!near[i * count + j])
                continue;
            ++pairs;
            distances += static_cast<double>(j - i);
            const bool has_next = j + 1 < count && near[(i + 1) * count + j + 1];
            const bool has_last = i > 0 && near[(i - 1) * count + j - 1];
            repeated += has_next || has_last;
        }
    }
    Recurrence found;
    const auto n = static_cast<double>(count);
    found.recurrence = pairs / (0.5 * n * (n - 1.0));
    if (pairs > 0.0) {
        found.determinism = repeated / pairs;
        found.return_distance = distances / (pairs * (n - 1.0));
    }
    return found;
}

std::optional<double> scan_match(std::span<const double> durations_a, std::span<const double> durations_b,
                                 const FixationDistance& distance, double threshold, double bin_s) {
    if (durations_a.empty() || durations_b.empty())
        return std::nullopt;
    std::vector<double> substitution;
    for (std::size_t i = 0; i < durations_a.size(); ++i) {
        for (std::size_t j = 0; j < durations_b.size(); ++j)
            substitution.push_back(std::max(-1.0, 1.0 - distance(i, j) / threshold));
    }
    const std::vector<std::size_t> a = in_bins(durations_a, bin_s), b = in_bins(durations_b, bin_s);
    std::vector<double> before(b.size() + 1, 0.0), now(b.size() + 1, 0.0);
    for (const std::size_t of_a : a) {
        for (std::size_t j = 0; j < b.size(); ++j)
            now[j + 1] =
                std::max({before[j] + substitution[of_a * durations_b.size() + b[j]], before[j + 1], now[j]});
        std::swap(before, now);
    }
    return before.back() / static_cast<double>(std::max(a.size(), b.size()));
}

std::optional<MultiMatch> multi_match(const GazeWay& a, const GazeWay& b, const FixationDistance& distance,
                                      double extent) {
    if (a.steps.empty() || b.steps.empty())
        return std::nullopt;
    std::vector<double> shapes, lengths, directions, positions, durations;
    for (const auto& [i, j] : aligned_steps(a.steps, b.steps)) {
        shapes.push_back(vector_difference(a.steps[i], b.steps[j]) / (2.0 * extent));
        lengths.push_back(std::abs(a.steps[i].length - b.steps[j].length) / extent);
        directions.push_back(angle_between(a.steps[i], b.steps[j]) / std::numbers::pi);
        positions.push_back(std::min(distance(i, j) / extent, 1.0));
        const double longer = std::max(a.durations[i], b.durations[j]);
        durations.push_back(longer > 0.0 ? std::abs(a.durations[i] - b.durations[j]) / longer : 0.0);
    }
    return MultiMatch{1.0 - std::min(median_of(shapes), 1.0), 1.0 - std::min(median_of(lengths), 1.0),
                      1.0 - median_of(directions), 1.0 - median_of(positions), 1.0 - median_of(durations)};
}

} // namespace overt
