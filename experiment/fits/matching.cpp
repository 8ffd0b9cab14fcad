#include "experiment/fits/matching.h"

#include <cmath>

namespace overt {

namespace {

/// Means and second moments about them.
struct MatchMoments {
    double count = 0.0, mean_x = 0.0, mean_y = 0.0, xx = 0.0, yy = 0.0, xy = 0.0;
};

MatchMoments moments_of(std::span<const MatchSettings> references) {
    MatchMoments moments;
    for (const MatchSettings& one : references)
        for (const double setting : one.settings) {
            moments.count += 1.0;
            moments.mean_x += one.reference;
            moments.mean_y += setting;
        }
    moments.mean_x /= moments.count;
    moments.mean_y /= moments.count;
    for (const MatchSettings& one : references)
        for (const double setting : one.settings) {
            const double x = one.reference - moments.mean_x, y = setting - moments.mean_y;
            moments.xx += x * x;
            moments.yy += y * y;
            moments.xy += x * y;
        }
    return moments;
}

} // namespace

std::vector<MatchEstimate> match_estimates(std::span<const MatchSettings> references) {
    std::vector<MatchEstimate> estimates;
    for (const MatchSettings& one : references) {
        MatchEstimate& estimate = estimates.emplace_back();
        estimate.reference = one.reference;
        const auto n = static_cast<double>(one.settings.size());
        for (const double setting : one.settings)
            estimate.point_of_equality += setting / n;
        estimate.constant_error = estimate.point_of_equality - one.reference;
        if (one.settings.size() < 2)
            continue;
        double squares = 0.0;
        for (const double setting : one.settings)
            squares += (setting - estimate.point_of_equality) * (setting - estimate.point_of_equality);
        estimate.sd = std::sqrt(squares / (n - 1.0));
        estimate.just_noticeable = 0.67448975019608171 * *estimate.sd; // the normal quantile of 3/4
    }
    return estimates;
}

std::optional<MatchLine> least_squares_line(std::span<const MatchSettings> references) {
    const MatchMoments moments = moments_of(references);
    if (references.size() < 2 || !(moments.xx > 0.0))
        return std::nullopt;
    const double slope = moments.xy / moments.xx;
    return MatchLine{slope, moments.mean_y - slope * moments.mean_x};
}

std::optional<MatchLine> deming_line(std::span<const MatchSettings> references) {
    const MatchMoments moments = moments_of(references);
    if (references.size() < 2 || !(moments.xx > 0.0) || moments.xy == 0.0)
        return std::nullopt;
    const double difference = moments.yy - moments.xx;
    const double slope = (difference + std::sqrt(difference * difference + 4.0 * moments.xy * moments.xy)) /
                         (2.0 * moments.xy);
    return MatchLine{slope, moments.mean_y - slope * moments.mean_x};
}

double brunswik_ratio(double match, double proximal, double distal) {
    return (match - proximal) / (distal - proximal);
}

double thouless_ratio(double match, double proximal, double distal) {
    return brunswik_ratio(std::log(match), std::log(proximal), std::log(distal));
}

} // namespace overt
