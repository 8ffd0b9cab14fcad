#include "experiment/statistics/map_similarity.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace overt {

namespace {

constexpr double tiny = std::numeric_limits<double>::epsilon();

struct Moments {
    double area = 0.0, mean = 0.0, variance = 0.0; ///< variance by N
};

Moments moments(std::span<const double> map, std::span<const double> areas) {
    Moments found;
    double sum = 0.0;
    for (std::size_t i = 0; i < map.size(); ++i) {
        found.area += areas[i];
        sum += areas[i] * map[i];
    }
    if (!(found.area > 0.0))
        return found;
    found.mean = sum / found.area;
    // Of what is left, so that a large mean costs no digits.
    double squares = 0.0;
    for (std::size_t i = 0; i < map.size(); ++i)
        squares += areas[i] * (map[i] - found.mean) * (map[i] - found.mean);
    found.variance = squares / found.area;
    return found;
}

/// Rounding of equal numbers leaves a variance of about this share of the mean's square.
bool is_constant(const Moments& of) {
    return !(of.area > 0.0) || of.variance <= 1e-28 * of.mean * of.mean || of.variance == 0.0;
}

struct Scaling {
    double shift = 0.0, factor = 0.0;
    double of(double value) const { return (value - shift) * factor; }
};

std::optional<Scaling> scaling_of(std::span<const double> map, std::span<const double> areas,
                                  SimConvention convention) {
    // A place without area is no place.
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (std::size_t i = 0; i < map.size(); ++i) {
        if (areas[i] > 0.0) {
            least = std::min(least, map[i]);
            most = std::max(most, map[i]);
        }
    }
    if (!(least <= most) || (convention == SimConvention::mit && !(least < most)))
        return std::nullopt;
    // Scaling to 0 … 1 before dividing by the integral changes nothing but the shift.
    Scaling scaling{convention == SimConvention::mit ? least : std::min(least, 0.0), 1.0};
    double sum = 0.0;
    for (std::size_t i = 0; i < map.size(); ++i)
        sum += areas[i] * scaling.of(map[i]);
    if (!(sum > 0.0))
        return std::nullopt;
    scaling.factor = 1.0 / sum;
    return scaling;
}

/// What makes probabilities of a density: on N equal areas, those of N pixels.
struct Probability {
    double factor = 0.0;
    double mean_area = 0.0;
};

std::optional<Probability> probability_of(std::span<const double> map, std::span<const double> areas) {
    const double total = integral(map, areas);
    double area = 0.0;
    std::size_t places = 0;
    for (const double one : areas) {
        area += one;
        places += one > 0.0;
    }
    if (!(total > 0.0) || places == 0)
        return std::nullopt;
    const double mean_area = area / static_cast<double>(places);
    return Probability{mean_area / total, mean_area};
}

} // namespace

double integral(std::span<const double> map, std::span<const double> areas) {
    double sum = 0.0;
    for (std::size_t i = 0; i < map.size(); ++i)
        sum += areas[i] * map[i];
    return sum;
}

std::optional<double> correlation(std::span<const double> a, std::span<const double> b,
                                  std::span<const double> areas) {
    const Moments of_a = moments(a, areas), of_b = moments(b, areas);
    if (is_constant(of_a) || is_constant(of_b))
        return std::nullopt;
    double together = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
        together += areas[i] * (a[i] - of_a.mean) * (b[i] - of_b.mean);
    const double r = together / of_a.area / std::sqrt(of_a.variance) / std::sqrt(of_b.variance);
    return std::clamp(r, -1.0, 1.0);
}

std::optional<double> similarity(std::span<const double> a, std::span<const double> b,
                                 std::span<const double> areas, SimConvention convention) {
    const std::optional<Scaling> of_a = scaling_of(a, areas, convention),
                                 of_b = scaling_of(b, areas, convention);
    if (!of_a || !of_b)
        return std::nullopt;
    double common = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
        common += areas[i] * std::min(of_a->of(a[i]), of_b->of(b[i]));
    return common;
}

std::optional<double> kl_divergence(std::span<const double> model, std::span<const double> truth,
                                    std::span<const double> areas) {
    const std::optional<Probability> of_model = probability_of(model, areas),
                                     of_truth = probability_of(truth, areas);
    if (!of_model || !of_truth)
        return std::nullopt;
    double sum = 0.0;
    for (std::size_t i = 0; i < model.size(); ++i) {
        const double p = of_model->factor * model[i], q = of_truth->factor * truth[i];
        sum += areas[i] / of_model->mean_area * q * std::log(tiny + q / (p + tiny));
    }
    return sum;
}

std::optional<double> nss(std::span<const double> map, std::span<const double> areas,
                          std::span<const double> at_fixations, NssConvention convention) {
    const Moments of = moments(map, areas);
    if (is_constant(of) || at_fixations.empty())
        return std::nullopt;
    double variance = of.variance;
    if (convention == NssConvention::sample) {
        const auto places = static_cast<double>(
            std::count_if(areas.begin(), areas.end(), [](double area) { return area > 0.0; }));
        variance *= places / (places - 1.0);
    }
    double sum = 0.0;
    for (const double value : at_fixations)
        sum += (value - of.mean) / std::sqrt(variance);
    return sum / static_cast<double>(at_fixations.size());
}

std::optional<double> information_gain(std::span<const double> map, std::span<const double> baseline,
                                       std::span<const double> areas,
                                       std::span<const double> map_at_fixations,
                                       std::span<const double> baseline_at_fixations) {
    const std::optional<Probability> of_map = probability_of(map, areas),
                                     of_baseline = probability_of(baseline, areas);
    if (!of_map || !of_baseline || map_at_fixations.empty())
        return std::nullopt;
    double sum = 0.0;
    for (std::size_t i = 0; i < map_at_fixations.size(); ++i)
        sum += std::log2(tiny + of_map->factor * map_at_fixations[i]) -
               std::log2(tiny + of_baseline->factor * baseline_at_fixations[i]);
    return sum / static_cast<double>(map_at_fixations.size());
}

} // namespace overt
